#include "Targets/FunctionShape.h"

#include "Targets/TargetOptions.h"

#include "Input/AttachedData.h"
#include "Targets/FunctionSampler.h"
#include "Targets/GridFunction.h"
#include "Targets/MovingTarget.h"
#include "Targets/TargetFrames.h"
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
namespace
{

// Target that moves between the shapes of two steps: F = (1 - f) F0 + f F1 at the fraction f of the
// interval. F0 and F1 are the functions of the two steps.
class BlendedTarget : public MovingTarget
{
public:
  // The caller owns the frames, which must contain the steps that MoveAlong uses; each step that is
  // not empty must have a function.
  // outside: value of a frame without a function. knowsParts: the parts of the functions are
  // available (GridFunction.h).
  BlendedTarget(
    const TargetFrames& frames, double outside, bool knowsParts, const TargetOptions& options);

  bool IsThreadSafe() const override;
  bool HasRegions() const override { return this->KnowsParts; }
  // Visits the parts of both steps.
  void ForEachPart(const PartVisitor& visit) const override;
  SurfacePoints FindSurface() const override;

protected:
  void Place(int step, double fraction) override;
  void Sample(
    std::size_t count, const double* points, double* values, double* gradients) const override;

private:
  struct Shape
  {
    int Step = -1;
    std::unique_ptr<FunctionSampler> Function; // null for an empty frame
    vtkSmartPointer<vtkImplicitFunction> Source;
  };

  void Use(int step, Shape& shape) const;
  void SampleShape(const Shape& shape, std::size_t count, const double* points, double* values,
    double* gradients) const;

  const TargetFrames& Frames;
  const double Outside;
  const bool KnowsParts;
  double Blend = 0.0; // weight of the later shape
  Shape Earlier, Later;
};

void AddWeighted(
  double weight, std::size_t count, const double* earlier, const double* later, double* sum)
{
  for (std::size_t i = 0; i < count; ++i)
  {
    sum[i] = (1.0 - weight) * earlier[i] + weight * later[i];
  }
}

BlendedTarget::BlendedTarget(
  const TargetFrames& frames, double outside, bool knowsParts, const TargetOptions& options)
  : MovingTarget(options)
  , Frames(frames)
  , Outside(outside)
  , KnowsParts(knowsParts)
{
}

bool BlendedTarget::IsThreadSafe() const
{
  const auto isSafe = [](const Shape& shape)
  { return !shape.Function || shape.Function->IsThreadSafe(); };
  return isSafe(this->Earlier) && isSafe(this->Later);
}

void BlendedTarget::Place(int step, double fraction)
{
  this->Use(step, this->Earlier);
  this->Blend = this->Frames.Has(step + 1) ? fraction : 0.0;
  if (this->Blend > 0.0)
  {
    this->Use(step + 1, this->Later);
  }
}

void BlendedTarget::Use(int step, Shape& shape) const
{
  if (step != shape.Step)
  {
    vtkImplicitFunction* function = this->Frames.GetFunction(step);
    shape.Source = function;
    shape.Function = function
      ? std::make_unique<FunctionSampler>(function, this->GetOptions().GetDifferenceStep())
      : nullptr;
    shape.Step = step;
  }
}

void BlendedTarget::ForEachPart(const PartVisitor& visit) const
{
  if (this->KnowsParts)
  {
    ForEachPartOf(this->Earlier.Source, this->GetOptions(), visit);
    ForEachPartOf(this->Blend > 0.0 ? this->Later.Source : nullptr, this->GetOptions(), visit);
  }
}

SurfacePoints BlendedTarget::FindSurface() const
{
  return this->Blend == 0.0 ? FindSurfaceOf(this->Earlier.Source, this->GetOptions())
                            : SurfacePoints();
}

void BlendedTarget::SampleShape(const Shape& shape, std::size_t count, const double* points,
  double* values, double* gradients) const
{
  if (shape.Function)
  {
    shape.Function->Sample(count, points, values, gradients);
    return;
  }
  std::fill_n(values, count, this->Outside);
  std::fill_n(gradients, gradients ? 3 * count : 0, 0.0);
}

void BlendedTarget::Sample(
  std::size_t count, const double* points, double* values, double* gradients) const
{
  this->SampleShape(this->Earlier, count, points, values, gradients);
  constexpr std::size_t batch = 128;
  double laterValues[batch];
  double laterGradients[3 * batch];
  for (std::size_t first = 0; first<count&& this->Blend> 0.0; first += batch)
  {
    const std::size_t size = std::min(batch, count - first);
    this->SampleShape(
      this->Later, size, points + 3 * first, laterValues, gradients ? laterGradients : nullptr);
    double* value = values + first;
    AddWeighted(this->Blend, size, value, laterValues, value);
    if (gradients)
    {
      double* gradient = gradients + 3 * first;
      AddWeighted(this->Blend, 3 * size, gradient, laterGradients, gradient);
    }
  }
}

}

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
