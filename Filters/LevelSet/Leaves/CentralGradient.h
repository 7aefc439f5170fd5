/**
 * The gradient at a single node of a tree. Passes over leaves use RowKernels.h.
 */
#ifndef CentralGradient_h
#define CentralGradient_h

#include "Base/OpenVDB.h"

#include <openvdb/Types.h>

namespace activesurface
{

/** Returns the squared norm of the gradient [change per voxel] at a node, by central differences in
 * the precision Real. valueAt(coordinates): the value of a node. */
template <class Real, class ValueAt>
Real CentralGradientSquare(const openvdb::Coord& node, ValueAt&& valueAt)
{
  Real square = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    openvdb::Coord low = node, high = node;
    --low[axis];
    ++high[axis];
    const Real difference = Real(.5) * (Real(valueAt(high)) - Real(valueAt(low)));
    square += difference * difference;
  }
  return square;
}

}

#endif
