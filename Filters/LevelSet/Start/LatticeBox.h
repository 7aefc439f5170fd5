/**
 * The nodes of the lattice within bounds.
 */
#ifndef LatticeBox_h
#define LatticeBox_h

#include "Base/OpenVDB.h"

#include <openvdb/Types.h>

namespace activesurface
{

/** Limit of node coordinates, which are 32-bit integers. */
constexpr double FarthestNode = 1e9;

/** Lattice nodes First..Last along each axis; the outermost nodes lie on or beyond the bounds, up
 * to rounding. */
struct LatticeBox
{
  openvdb::Coord First;
  openvdb::Coord Last;

  int Size(int axis) const { return this->Last[axis] - this->First[axis] + 1; }
  bool Closes(const openvdb::Coord& node) const
  {
    bool closes = false;
    for (int axis = 0; axis < 3; ++axis)
    {
      closes = closes || node[axis] <= this->First[axis] || node[axis] >= this->Last[axis];
    }
    return closes;
  }
};

/** Throws std::invalid_argument for bounds that are empty, not finite, or 10^9 voxels or more from
 * 0. */
LatticeBox FindLatticeBox(double voxelSize, const double bounds[6]);

}

#endif
