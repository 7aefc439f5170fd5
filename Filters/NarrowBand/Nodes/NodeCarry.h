/**
 * The potential carried by the motion of the target: u(x) becomes u(x - D(x)).
 */
#ifndef NodeCarry_h
#define NodeCarry_h

#include "Nodes/NodeLeaves.h"

namespace activesurface
{

/** The potential of the last frame. */
struct OldPotential
{
  const LeafTable& Leaves;
  const PotentialTree& Tree;

  const BandLeaf* FindLeaf(const NodeIndex& origin) const
  {
    const std::int32_t i = this->Leaves.Find(openvdb::Coord(origin[0], origin[1], origin[2]));
    return i >= 0 ? &this->Leaves[i] : nullptr;
  }

  /** The 512 values of a leaf, or null. */
  const float* Find(const NodeIndex& origin) const
  {
    const BandLeaf* leaf = this->FindLeaf(origin);
    return leaf ? leaf->Value : nullptr;
  }

  /** + or - NodeLimit, the side of a leaf for which Find returns null. */
  float SideOf(const NodeIndex& origin) const
  {
    const bool isInside =
      this->Tree.getValue(openvdb::Coord(origin[0], origin[1], origin[2])) < 0.f;
    return isInside ? -NodeLimit : NodeLimit;
  }
};

/** Writes the carried values of a leaf, at most NodeLimit in size. D is linear between the points
 * of the motion; values are interpolated linearly, with second differences along the axes. Keeps
 * `psi` where neighbouring points of the motion are more than a hundred voxels apart. */
void CarryNodes(const OldPotential& old, const NodeLeaf& leaf, const LeafMotion& motion,
  const float* psi, float* carried);

}

#endif
