#include "Targets/BlendedTarget.h"

#include "Targets/GridFunction.h"
#include "Targets/TargetFrames.h"

#include <algorithm>

namespace activesurface
{

namespace
{

void AddWeighted(
  double weight, std::size_t count, const double* earlier, const double* later, double* sum)
{
  for (std::size_t i = 0; i < count; ++i)
  {
    sum[i] = (1.0 - weight) * earlier[i] + weight * later[i];
  }
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
