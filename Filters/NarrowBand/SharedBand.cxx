#include "SharedBand.h"

#include <algorithm>
#include <cmath>

namespace activesurface
{

namespace
{

/** The edges of a leaf, on which samples are, end so far beside it [voxels]. */
constexpr double Margin = 1.0;

/** Of more rows of leaves it is not worth the time to look at each. */
constexpr std::int64_t MostRows = 256;

/** The leaf that holds a place; far away, and where it is not a number, the last one. */
int OriginAt(double voxel)
{
  constexpr double most = 1 << 30;
  return 8 * static_cast<int>(std::floor(std::min(std::max(voxel, -most), most) / 8.0));
}

}

bool OwnLeaves::Has(const double x[3]) const
{
  openvdb::Coord origin;
  for (int axis = 0; axis < 3; ++axis)
  {
    origin[axis] = OriginAt(x[axis] / this->VoxelSize);
  }
  return this->Owners.FindOwner(origin) == this->Owners.GetRank();
}

bool OwnLeaves::Touches(const double bounds[6]) const
{
  openvdb::Coord first, last;
  for (int axis = 0; axis < 3; ++axis)
  {
    first[axis] = OriginAt(bounds[2 * axis] / this->VoxelSize - Margin);
    last[axis] = OriginAt(bounds[2 * axis + 1] / this->VoxelSize + Margin);
  }
  // Leaves between two corners are between them in the order of the tree, too.
  const int rank = this->Owners.GetRank();
  const auto mayOwnBetween = [&](const openvdb::Coord& low, const openvdb::Coord& high)
  { return this->Owners.FindOwner(low) <= rank && rank <= this->Owners.FindOwner(high); };
  if (!mayOwnBetween(first, last))
  {
    return false;
  }
  const auto countOf = [&](int axis)
  { return (static_cast<std::int64_t>(last[axis]) - first[axis]) / 8 + 1; };
  if (this->Owners.FindOwner(first) == this->Owners.FindOwner(last) ||
    countOf(0) > MostRows / countOf(1))
  {
    return true;
  }
  for (int x = first[0]; x <= last[0]; x += 8)
  {
    for (int y = first[1]; y <= last[1]; y += 8)
    {
      if (mayOwnBetween({ x, y, first[2] }, { x, y, last[2] }))
      {
        return true;
      }
    }
  }
  return false;
}

}
