/**
 * Positions in the cells of a lattice, for interpolation between nodes.
 */
#ifndef LatticeCell_h
#define LatticeCell_h

#include "Base/OpenVDB.h"

#include <cmath>

namespace activesurface
{

/** The voxel that contains a position [voxels], and the fractions of the position in the voxel, as
 * in Trilinear.h. */
struct LatticeCell
{
  /** place: has to fit into lattice coordinates. */
  explicit LatticeCell(const double place[3])
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Lowest[axis] = static_cast<int>(std::floor(place[axis]));
      this->Fraction[axis] = place[axis] - this->Lowest[axis];
    }
  }

  openvdb::Coord Corner(int c) const { return this->Lowest.offsetBy(c >> 2, c >> 1 & 1, c & 1); }

  openvdb::Coord Lowest; //< corner 0
  double Fraction[3];
};

/** Returns true if a position [voxels] is more than a voxel outside a box of nodes along an axis,
 * if the box is empty, or if the position is NaN. All other positions fit into lattice coordinates.
 */
inline bool IsBeyond(const openvdb::CoordBBox& nodes, const double place[3])
{
  bool isBeyond = nodes.empty();
  for (int axis = 0; axis < 3; ++axis)
  {
    isBeyond = isBeyond ||
      !(place[axis] >= nodes.min()[axis] - 1.0 && place[axis] <= nodes.max()[axis] + 1.0);
  }
  return isBeyond;
}

}

#endif
