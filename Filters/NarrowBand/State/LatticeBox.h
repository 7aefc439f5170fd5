/**
 * The nodes of the lattice within bounds.
 */
#ifndef LatticeBox_h
#define LatticeBox_h

#include "OpenVDB.h"

#include <openvdb/Types.h>

namespace activesurface
{

/** Node numbers are 32-bit integers. */
constexpr double FarthestNode = 1e9;

/** Lattice nodes first..last of the three axes; the outermost ones lie on or beyond the bounds. */
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

/** Throws std::invalid_argument for bounds that are empty, not finite or absurd for the voxel size.
 */
LatticeBox FindLatticeBox(double voxelSize, const double bounds[6]);

}

#endif
