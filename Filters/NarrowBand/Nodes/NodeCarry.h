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

/** Writes the carried values of a leaf, at most NodeLimit in size. D is linear between the points
 * of the motion; values are interpolated linearly, with second differences along the axes. Keeps
 * `psi` where neighbouring points of the motion are more than a hundred voxels apart. */
void CarryNodes(const OldPotential& old, const NodeLeaf& leaf, const LeafMotion& motion,
  const float* psi, float* carried);

/** Adds the origins of the old leaves that CarryNodes reads for a leaf, and its own. */
void ListOldLeaves(const NodeLeaf& leaf, const LeafMotion& motion, std::vector<NodeIndex>& origins);

}

#endif
