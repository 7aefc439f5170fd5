#include "Surface/LatticeSurface.h"

#include "Base/LatticeShape.h"
#include "Base/OpenVDB.h"
#include "Leaves/LeafFaces.h"

#include <openvdb/tree/ValueAccessor.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

namespace activesurface
{

namespace
{

using MaskAccessor = openvdb::tree::ValueAccessor<const openvdb::MaskTree>;

LeafMask MaskAt(const MaskAccessor& inside, const openvdb::Coord& origin)
{
  LeafMask mask;
  if (const auto* leaf = inside.probeConstLeaf(origin))
  {
    for (int x = 0; x < 8; ++x)
    {
      mask.Word[x] = leaf->getValueMask().getWord<std::uint64_t>(x);
    }
    return mask;
  }
  return inside.isValueOn(origin) ? LeafMask::All() : mask;
}

/** 8^3 cells, numbered by their lower corners. */
struct CellBlock
{
  openvdb::Coord Origin;
  LeafMask Cells;
};

/** Returns the cells of a block whose corners differ in sign. */
LeafMask FindMixedCells(const MaskAccessor& inside, const openvdb::Coord& origin)
{
  LeafMask all[8], any[8]; // of the block ahead by (x, y, z): index 4 x + 2 y + z
  for (int ahead = 0; ahead < 8; ++ahead)
  {
    all[ahead] = any[ahead] =
      MaskAt(inside, origin.offsetBy(8 * (ahead >> 2), 8 * (ahead >> 1 & 1), 8 * (ahead & 1)));
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    const int count = 4 >> axis; // remaining blocks
    for (int i = 0; i < count; ++i)
    {
      all[i] = all[i] & SeenAhead(all[i], all[i + count], axis, 1);
      any[i] = any[i] | SeenAhead(any[i], any[i + count], axis, 1);
    }
  }
  return any[0].Without(all[0]);
}

/** Returns the origins of the blocks whose cells have a corner in a leaf. */
std::vector<openvdb::Coord> FindBlocks(const openvdb::MaskTree& inside)
{
  std::vector<openvdb::Coord> blocks;
  for (auto leaf = inside.cbeginLeaf(); leaf; ++leaf)
  {
    for (int behind = 0; behind < 8; ++behind)
    {
      blocks.push_back(
        leaf->origin().offsetBy(-8 * (behind >> 2), -8 * (behind >> 1 & 1), -8 * (behind & 1)));
    }
  }
  std::sort(blocks.begin(), blocks.end());
  blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
  return blocks;
}

/** Returns true if an inside tile touches an outside tile. */
bool IsTileBare(const MaskAccessor& inside, const openvdb::CoordBBox& tile)
{
  for (int face = 0; face < 6; ++face)
  {
    const int axis = face / 2, b = (axis + 1) % 3, c = (axis + 2) % 3;
    openvdb::Coord node;
    node[axis] = face % 2 ? tile.max()[axis] + 1 : tile.min()[axis] - 1;
    for (node[b] = tile.min()[b]; node[b] <= tile.max()[b]; node[b] += 8)
    {
      for (node[c] = tile.min()[c]; node[c] <= tile.max()[c]; node[c] += 8)
      {
        if (!inside.probeConstLeaf(node) && !inside.isValueOn(node))
        {
          return true;
        }
      }
    }
  }
  return false;
}

bool HasBareTile(const openvdb::MaskTree& inside)
{
  const MaskAccessor accessor(inside);
  auto tile = inside.cbeginValueOn();
  tile.setMaxDepth(openvdb::MaskTree::ValueOnCIter::LEAF_DEPTH - 1);
  for (; tile; ++tile)
  {
    if (IsTileBare(accessor, tile.getBoundingBox()))
    {
      return true;
    }
  }
  return false;
}

void FindBounds(const LatticeShape& shape, double bounds[6])
{
  openvdb::CoordBBox box;
  shape.Inside.evalActiveVoxelBoundingBox(box);
  box.expand(1);
  for (int corner = 0; corner < 8; ++corner)
  {
    openvdb::Vec3d node;
    for (int axis = 0; axis < 3; ++axis)
    {
      node[axis] = corner >> axis & 1 ? box.max()[axis] : box.min()[axis];
    }
    const openvdb::Vec3d place = shape.PlaceOf(node);
    for (int axis = 0; axis < 3; ++axis)
    {
      double &low = bounds[2 * axis], &high = bounds[2 * axis + 1];
      low = corner == 0 ? place[axis] : std::min(low, place[axis]);
      high = corner == 0 ? place[axis] : std::max(high, place[axis]);
    }
  }
}

void VisitCells(const CellBlock& block, const LatticeShape& axes,
  const std::function<void(const double x[3])>& visit)
{
  block.Cells.ForEach(
    [&](int node)
    {
      const openvdb::Coord cell = block.Origin.offsetBy(node >> 6, (node >> 3) & 7, node & 7);
      visit(axes.PlaceOf(cell.asVec3d() + openvdb::Vec3d(.5)).asPointer());
    });
}

}

SurfacePoints FindSurfacePoints(const LatticeShape& shape)
{
  SurfacePoints points;
  if (HasBareTile(shape.Inside))
  {
    return points;
  }
  auto cells = std::make_shared<std::vector<CellBlock>>();
  const MaskAccessor inside(shape.Inside);
  for (const openvdb::Coord& origin : FindBlocks(shape.Inside))
  {
    const LeafMask mixed = FindMixedCells(inside, origin);
    if (mixed.Any())
    {
      cells->push_back({ origin, mixed });
    }
  }
  auto axes = std::make_shared<LatticeShape>();
  axes->Origin = shape.Origin;
  for (int axis = 0; axis < 3; ++axis)
  {
    axes->Axis[axis] = shape.Axis[axis];
    const double half = .5 *
      (std::fabs(shape.Axis[0][axis]) + std::fabs(shape.Axis[1][axis]) +
        std::fabs(shape.Axis[2][axis]));
    points.Reach = std::max(points.Reach, half);
  }
  FindBounds(shape, points.Bounds);
  points.ForEach = [cells, axes](const std::function<void(const double x[3])>& visit)
  {
    for (const CellBlock& block : *cells)
    {
      VisitCells(block, *axes, visit);
    }
  };
  return points;
}

}
