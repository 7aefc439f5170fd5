// Finds the voxels of a tree whose values are inside a shape.

#ifndef InsideMask_h
#define InsideMask_h

#include "Base/OpenVDB.h"

#include <openvdb/tree/LeafManager.h>

#include <cstddef>
#include <vector>

namespace activesurface
{

// Activates in `inside` the voxels and tiles of `values` for which isInside(value). The background
// of `inside` stays inactive.
template <class IsInside>
void FindInside(
  const openvdb::FloatTree& values, const IsInside& isInside, openvdb::MaskTree& inside)
{
  using Leaf = openvdb::MaskTree::LeafNodeType;
  auto tile = values.cbeginValueAll();
  tile.setMaxDepth(openvdb::FloatTree::ValueAllCIter::LEAF_DEPTH - 1);
  for (; tile; ++tile)
  {
    if (isInside(*tile))
    {
      inside.addTile(tile.getLevel(), tile.getCoord(), true, true);
    }
  }
  openvdb::tree::LeafManager<const openvdb::FloatTree> leaves(values);
  std::vector<Leaf*> made(leaves.leafCount());
  leaves.foreach (
    [&](const openvdb::FloatTree::LeafNodeType& leaf, std::size_t i)
    {
      made[i] = new Leaf(leaf.origin()); // owned by the tree from addLeaf on
      for (openvdb::Index node = 0; node < Leaf::SIZE; ++node)
      {
        made[i]->setActiveState(node, isInside(leaf.getValue(node)));
      }
    });
  for (Leaf* leaf : made)
  {
    inside.addLeaf(leaf);
  }
}

}

#endif
