/**
 * The part of a potential within walls, closed at them.
 */
#ifndef BoxCut_h
#define BoxCut_h

#include "Base/Walls.h"
#include "Leaves/LeafTable.h"

namespace activesurface
{

/** Returns the maximum of a potential [voxels] and the depth in the walls, near its zero set. */
openvdb::FloatTree::Ptr CutAtWalls(
  const openvdb::FloatTree& whole, const Walls& walls, double voxelSize);

}

#endif
