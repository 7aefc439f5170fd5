#include "State/BoxCut.h"

#include "Base/OpenVDB.h"

#include <openvdb/tools/SignedFloodFill.h>

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace activesurface
{

namespace
{

using openvdb::Coord;
using openvdb::CoordBBox;

/** Number of nodes with values on either side of a wall. */
constexpr int Band = 3;

/** Adds leaves inside the surface near one side of the walls. wall: coordinate of the side
 * [voxels]. */
void AddLeavesAt(openvdb::FloatTree& tree, const CoordBBox& leaves, int axis, double wall)
{
  const double low = leaves.min()[axis], high = leaves.max()[axis];
  if (!(wall > low - Band && wall < high + Band))
  {
    return;
  }
  CoordBBox slab = leaves;
  slab.min()[axis] = static_cast<int>(std::floor(wall)) - Band;
  slab.max()[axis] = static_cast<int>(std::ceil(wall)) + Band;
  for (const Coord& number : CoordBBox(slab.min() >> 3, slab.max() >> 3))
  {
    const Coord origin = number << 3;
    if (!tree.probeConstLeaf(origin) && tree.getValue(origin) < 0.f)
    {
      tree.addLeaf(new PotentialLeaf(origin, -Far, true));
    }
  }
}

void CutLeaf(PotentialLeaf& leaf, const Walls& walls, double voxelSize)
{
  const Coord& origin = leaf.origin();
  for (int n = 0; n < 512; ++n)
  {
    const double place[3] = { voxelSize * (origin[0] + (n >> 6)),
      voxelSize * (origin[1] + (n >> 3 & 7)), voxelSize * (origin[2] + (n & 7)) };
    const auto depth = static_cast<float>(
      std::max(DistanceToWalls(walls, place) / voxelSize, -static_cast<double>(Far)));
    leaf.setValueOn(n, std::min(std::max(leaf.getValue(n), depth), Far));
  }
}

CoordBBox BoxOf(const Walls& walls, double voxelSize, const CoordBBox& leaves)
{
  CoordBBox box = leaves;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double low = std::ceil(walls.Bounds[2 * axis] / voxelSize) - Band;
    const double high = std::floor(walls.Bounds[2 * axis + 1] / voxelSize) + Band;
    box.min()[axis] = static_cast<int>(std::max(low, double(leaves.min()[axis])));
    box.max()[axis] = static_cast<int>(std::min(high, double(leaves.max()[axis])));
  }
  return box;
}

}

openvdb::FloatTree::Ptr CutAtWalls(
  const openvdb::FloatTree& whole, const Walls& walls, double voxelSize)
{
  auto tree = std::make_shared<openvdb::FloatTree>(whole);
  CoordBBox leaves;
  if (!tree->evalLeafBoundingBox(leaves))
  {
    return tree;
  }
  for (int side = 0; side < 6; ++side)
  {
    AddLeavesAt(*tree, leaves, side / 2, walls.Bounds[side] / voxelSize);
  }
  std::vector<PotentialLeaf*> all;
  tree->getNodes(all);
  tbb::parallel_for(
    std::size_t{ 0 }, all.size(), [&](std::size_t i) { CutLeaf(*all[i], walls, voxelSize); });
  tree->clip(BoxOf(walls, voxelSize, leaves));
  openvdb::tools::signedFloodFillWithValues(*tree, Far, -Far);
  return tree;
}

}
