#include "Targets/FunctionShape.h"

#include "Targets/BlendedTarget.h"

#include "Input/AttachedData.h"
#include "vtkImageData.h"
#include "vtkImplicitFunction.h"
#include "vtkNew.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <memory>
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

void FunctionShape::MoveBy(const double offset[3])
{
  this->Function = nullptr;
  if (auto image = vtkImageData::SafeDownCast(this->Data))
  {
    const double* origin = image->GetOrigin();
    image->SetOrigin(origin[0] + offset[0], origin[1] + offset[1], origin[2] + offset[2]);
    MoveAttachedGrid(image->GetInformation(), offset);
    return;
  }
  auto mesh = vtkPointSet::SafeDownCast(this->Data);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(mesh->GetNumberOfPoints());
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    const double* x = mesh->GetPoint(i);
    points->SetPoint(i, x[0] + offset[0], x[1] + offset[1], x[2] + offset[2]);
  }
  mesh->SetPoints(points);
}

std::unique_ptr<MovingTarget> FunctionShape::MakeBlend(
  const TargetFrames& frames, double outside, const TargetOptions& options) const
{
  return std::make_unique<BlendedTarget>(frames, outside, this->KnowsParts(), options);
}

}
