#include "Targets/FunctionShape.h"

#include "Targets/BlendedTarget.h"
#include "Targets/ShapeOptions.h"

#include <utility>

namespace activesurface
{

FunctionShape::FunctionShape(vtkSmartPointer<vtkDataSet> data)
  : Data(std::move(data))
{
}

vtkSmartPointer<vtkDataSet> FunctionShape::CopyPointsAndCells(vtkDataSet* data)
{
  vtkSmartPointer<vtkDataSet> structure;
  structure.TakeReference(data->NewInstance());
  structure->CopyStructure(data);
  vtkSmartPointer<vtkDataSet> copy;
  copy.TakeReference(data->NewInstance());
  copy->DeepCopy(structure);
  return copy;
}

std::unique_ptr<MovingTarget> FunctionShape::MakeBlend(const TargetFrames& frames,
  const ShapeOptions& options, double outside, const TargetOptions& level) const
{
  return std::make_unique<BlendedTarget>(
    frames, options.GetDifferenceStep(), outside, this->KnowsParts(), level);
}

}
