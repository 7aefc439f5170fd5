#include "Start/LatticeBox.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace activesurface
{

namespace
{

[[noreturn]] void RefuseBounds(const double bounds[6], const char* why)
{
  std::ostringstream text;
  text << "The bounds (" << bounds[0] << ", " << bounds[1] << ", " << bounds[2] << ", " << bounds[3]
       << ", " << bounds[4] << ", " << bounds[5] << ") " << why;
  throw std::invalid_argument(text.str());
}

}

LatticeBox FindLatticeBox(double voxelSize, const double bounds[6])
{
  constexpr double rounding = 1e-6;
  LatticeBox box;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double low = bounds[2 * axis] / voxelSize, high = bounds[2 * axis + 1] / voxelSize;
    if (!(high > low) || !std::isfinite(bounds[2 * axis]) || !std::isfinite(bounds[2 * axis + 1]))
    {
      RefuseBounds(bounds, "are empty or not finite; set ModelBounds around the shape.");
    }
    if (!(std::fabs(low) < FarthestNode && std::fabs(high) < FarthestNode))
    {
      RefuseBounds(bounds,
        "hold about 10^9 voxels or more along an axis; enlarge VoxelSize, set smaller "
        "ModelBounds, or remove points far from all others.");
    }
    box.First[axis] = static_cast<int>(std::floor(low + rounding));
    box.Last[axis] = static_cast<int>(std::ceil(high - rounding));
  }
  return box;
}

}
