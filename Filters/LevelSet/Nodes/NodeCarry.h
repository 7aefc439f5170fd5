/**
 * The potential carried by the motion of the target: u(x) becomes u(x - D(x)).
 */
#ifndef NodeCarry_h
#define NodeCarry_h

#include "Nodes/NodeLeaves.h"
#include "Nodes/OldPotential.h"

#include <vector>

namespace activesurface
{

/** Writes the carried values of a leaf, clamped to +-NodeLimit. The displacement D is linear
 * between the points of the motion. Old values are interpolated linearly, corrected by second
 * differences along the axes. A row is set to `psi` if the old nodes that the row needs fill a box
 * of more than 128^3 nodes. */
void CarryNodes(const OldPotential& old, const NodeLeaf& leaf, const LeafMotion& motion,
  const float* psi, float* carried);

/** Adds the leaf's own origin and the origins of the old leaves that CarryNodes reads for the leaf.
 */
void ListOldLeaves(const NodeLeaf& leaf, const LeafMotion& motion, std::vector<NodeIndex>& origins);

}

#endif
