/**
 * A shape on a lattice of its own: its inside nodes and their positions.
 */
#ifndef LatticeShape_h
#define LatticeShape_h

#include "Base/OpenVDB.h"

#include <openvdb/Types.h>

namespace activesurface
{

struct LatticeShape
{
  using Point = openvdb::Vec3d;

  /** Active nodes and tiles are inside, the background is outside. */
  openvdb::MaskTree Inside;

  Point Origin{ 0.0 }; //< of the node (0, 0, 0)
  Point Axis[3] = { Point(1.0, 0.0, 0.0), Point(0.0, 1.0, 0.0), Point(0.0, 0.0, 1.0) };

  /** Returns the position of a node [world units]. */
  Point PlaceOf(const Point& node) const
  {
    return this->Origin + node[0] * this->Axis[0] + node[1] * this->Axis[1] +
      node[2] * this->Axis[2];
  }
};

}

#endif
