#include "March/ArrivingTarget.h"

#include <cmath>

namespace activesurface
{

void ArrivingTarget::MoveTo(double time)
{
  this->Goal.MoveTo(time);
  this->IsAwake = this->HasWoken;
  this->HasWoken = false;
}

bool ArrivingTarget::MayHaveChanged(const double bounds[6]) const
{
  return this->IsAwake || this->Goal.MayHaveChanged(bounds);
}

void ArrivingTarget::Evaluate(
  std::size_t count, const double* points, const TargetResults& results) const
{
  this->Goal.Evaluate(count, points, results);
  constexpr std::size_t batch = 128;
  bool grow[batch];
  double remaining[batch];
  for (std::size_t first = 0; first < count; first += batch)
  {
    const std::size_t size = std::min(batch, count - first);
    double* values = results.Values + first;
    std::transform(values, values + size, grow, [](double value) { return value < 0.0; });
    this->Remaining.Find(size, points + 3 * first, grow, remaining);
    for (std::size_t i = 0; i < size; ++i)
    {
      this->Lengthen(remaining[i], values[i], results.Slopes[first + i]);
    }
  }
}

// Lengthens the value to the remaining distance, which falls linearly to 0 within a voxel of the
// target. The result is at least |F|, or two voxels if |F| is larger.
void ArrivingTarget::Lengthen(double remaining, double& value, double& slope) const
{
  const double distance = std::fabs(value), voxel = this->VoxelSize;
  if (!(remaining >= 0.0) || !std::isfinite(value))
  {
    return;
  }
  const double near = std::min(distance, 2.0 * voxel);
  const double far = remaining * std::min(distance / voxel, 1.0);
  if (far > near)
  {
    slope = distance < voxel ? slope * remaining / voxel : 1.0;
  }
  value = std::copysign(std::max(far, near), value);
}

}
