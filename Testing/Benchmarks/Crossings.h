/**
 * Zeros of a potential in a grid: the linear crossings of the lattice's edges, which are the points
 * of the skin. Both sides of a comparison are thus measured alike.
 */
#ifndef Crossings_h
#define Crossings_h

#include <openvdb/openvdb.h>

#include <vector>

namespace activesurface
{

/** x y z of each crossing; node (i,j,k) is at (i,j,k) * voxelSize. */
inline std::vector<double> FindCrossings(const openvdb::FloatGrid& grid, double voxelSize)
{
  std::vector<double> points;
  auto values = grid.getConstAccessor();
  for (auto node = grid.cbeginValueOn(); node; ++node)
  {
    const openvdb::Coord at = node.getCoord();
    for (int axis = 0; axis < 3; ++axis)
    {
      openvdb::Coord next = at;
      ++next[axis];
      const double value = *node;
      const double beyond = values.getValue(next);
      if ((value < 0.0) != (beyond < 0.0))
      {
        openvdb::Vec3d point = at.asVec3d();
        point[axis] += value / (value - beyond);
        point *= voxelSize;
        points.insert(points.end(), { point[0], point[1], point[2] });
      }
    }
  }
  return points;
}

}

#endif
