#include "Targets/FunctionObstacle.h"

#include "Targets/FunctionSampler.h"

#include <cmath>
#include <cstddef>
#include <vector>

namespace activesurface
{

namespace
{

double FindDistance(double value, const double gradient[3])
{
  const double slope = std::hypot(gradient[0], gradient[1], gradient[2]);
  const double far = value == 0.0 ? 0.0 : HUGE_VAL * value;
  return std::isfinite(slope) && slope > 0.0 ? value / slope : far;
}

}

std::unique_ptr<Obstacle> MakeObstacle(
  vtkImplicitFunction* function, double voxelSize, const std::array<double, 3>& origin)
{
  // Step of the differences that replace gradients a function does not provide [voxels].
  constexpr double step = 0.125;
  const auto sampler = std::make_shared<const FunctionSampler>(function, step * voxelSize, origin);
  const auto distances = [sampler](std::size_t count, const double* points, double* results)
  {
    std::vector<double> gradients(3 * count);
    sampler->Sample(count, points, results, gradients.data());
    for (std::size_t i = 0; i < count; ++i)
    {
      results[i] = FindDistance(results[i], gradients.data() + 3 * i);
    }
  };
  return std::make_unique<Obstacle>(voxelSize, distances, sampler->IsThreadSafe());
}

}
