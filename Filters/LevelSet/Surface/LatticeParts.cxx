#include "Surface/LatticeParts.h"

#include "Base/LatticeShape.h"
#include "Base/OpenVDB.h"
#include "Leaves/LeafFaces.h"

#include <openvdb/tree/ValueAccessor.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>

namespace activesurface
{

namespace
{

constexpr std::int32_t Unbounded = 0; // the component of the background

/** A leaf, or a tile of one value. */
struct Block
{
  openvdb::Coord Origin;
  std::int32_t Size;  // nodes along an axis: 8 in a leaf, 8 or more in a tile
  std::int32_t First; // first component; components end at First of the next block
};

/** Connected nodes of a block. */
struct Component
{
  std::int32_t Block;
  bool IsInside;
  LeafMask Nodes; // in a tile: all
};

/** Components of all blocks, joined across the faces of the blocks. */
class Components
{
public:
  explicit Components(const openvdb::MaskTree& inside)
  {
    this->All.push_back({ -1, false, LeafMask() }); // Unbounded
    this->AddLeaves(inside);
    this->AddTiles(inside);
    this->Blocks.push_back({ {}, 0, static_cast<std::int32_t>(this->All.size()) }); // the end
    for (std::size_t i = 0; i < this->All.size(); ++i)
    {
      this->Parent.push_back(static_cast<std::int32_t>(i));
    }
    for (std::size_t block = 0; block + 1 < this->Blocks.size(); ++block)
    {
      for (int face = 0; face < 6; ++face)
      {
        this->Connect(static_cast<std::int32_t>(block), face / 2, face % 2 ? 1 : -1);
      }
    }
  }

  std::size_t Size() const { return this->All.size(); }
  const Component& operator[](std::size_t i) const { return this->All[i]; }
  const Block& BlockOf(const Component& component) const { return this->Blocks[component.Block]; }

  /** Returns the smallest number of the components connected with component i. */
  std::int32_t FindRoot(std::int32_t i)
  {
    while (this->Parent[i] != i)
    {
      i = this->Parent[i] = this->Parent[this->Parent[i]];
    }
    return i;
  }

private:
  void AddLeaves(const openvdb::MaskTree& inside)
  {
    for (auto leaf = inside.cbeginLeaf(); leaf; ++leaf)
    {
      LeafMask mask;
      for (int x = 0; x < 8; ++x)
      {
        mask.Word[x] = leaf->getValueMask().getWord<std::uint64_t>(x);
      }
      this->AddBlock(leaf->origin(), 1, 8);
      this->Split(mask, true);
      this->Split(LeafMask::All().Without(mask), false);
    }
  }

  /**
   * Adds the tiles in the box of all leaves and inside nodes; tiles outside the box are background.
   * The box limits the number of tiles: a child of the root has 32^3 tiles.
   */
  void AddTiles(const openvdb::MaskTree& inside)
  {
    openvdb::CoordBBox all, leaves;
    inside.evalActiveVoxelBoundingBox(all);
    inside.evalLeafBoundingBox(leaves);
    all.expand(leaves);
    auto tile = inside.cbeginValueAll();
    tile.setMaxDepth(openvdb::MaskTree::ValueAllCIter::LEAF_DEPTH - 1);
    for (; tile; ++tile)
    {
      const openvdb::CoordBBox box = tile.getBoundingBox();
      if (all.hasOverlap(box))
      {
        this->AddBlock(box.min(), tile.getLevel(), box.dim()[0]);
        this->Split(LeafMask::All(), tile.isValueOn());
      }
    }
  }

  void AddBlock(const openvdb::Coord& origin, openvdb::Index level, int size)
  {
    const auto number = static_cast<std::int32_t>(this->Blocks.size());
    this->Blocks.push_back({ origin, size, static_cast<std::int32_t>(this->All.size()) });
    this->Numbers.addTile(level, origin, number, true);
  }

  /** Splits nodes into connected components of the last block. */
  void Split(LeafMask nodes, bool areInside)
  {
    while (nodes.Any())
    {
      LeafMask seed;
      for (int x = 0; x < 8 && !seed.Any(); ++x)
      {
        seed.Word[x] = nodes.Word[x] & (~nodes.Word[x] + 1u); // the lowest bit
      }
      const LeafMask connected = nodes == LeafMask::All() ? nodes : GrowInLeaf(seed, nodes);
      this->All.push_back(
        { static_cast<std::int32_t>(this->Blocks.size()) - 1, areInside, connected });
      nodes = nodes.Without(connected);
    }
  }

  /** Joins the components of a block with the components across a face. Does nothing if the block
   * across the face is smaller, because the call for the smaller block joins these components. */
  void Connect(std::int32_t block, int axis, int sign)
  {
    const Block& own = this->Blocks[block];
    openvdb::Coord next = own.Origin;
    next[axis] += sign > 0 ? own.Size : -1;
    const std::int32_t other = this->Recent.getValue(next);
    if (other >= 0 && this->Blocks[other].Size < own.Size)
    {
      return;
    }
    for (std::int32_t i = own.First; i < this->Blocks[block + 1].First; ++i)
    {
      if (!TouchesFace(this->All[i].Nodes, axis, sign))
      {
        continue;
      }
      if (other < 0)
      {
        this->Join(i, this->All[i].IsInside ? i : Unbounded);
        continue;
      }
      for (std::int32_t j = this->Blocks[other].First; j < this->Blocks[other + 1].First; ++j)
      {
        const LeafMask across = SeenAcross(this->All[i].Nodes, axis, sign);
        if (this->All[i].IsInside == this->All[j].IsInside && (across & this->All[j].Nodes).Any())
        {
          this->Join(i, j);
        }
      }
    }
  }

  void Join(std::int32_t i, std::int32_t j)
  {
    const std::int32_t a = this->FindRoot(i), b = this->FindRoot(j);
    this->Parent[std::max(a, b)] = std::min(a, b);
  }

  std::vector<Block> Blocks;
  std::vector<Component> All;
  std::vector<std::int32_t> Parent;
  openvdb::Int32Tree Numbers{ -1 }; // of the blocks
  openvdb::tree::ValueAccessor<openvdb::Int32Tree> Recent{ this->Numbers };
};

/** Erodes nodes, in at most 8 steps, until another step would remove all nodes. Returns the
 * remaining nodes; depth: the number of steps. Nodes beyond the leaf count as set. */
LeafMask FindDeepest(LeafMask nodes, int& depth)
{
  constexpr int most = 8;
  const LeafMask all = LeafMask::All();
  for (depth = 0; depth < most; ++depth)
  {
    LeafMask left = nodes;
    for (int axis = 0; axis < 3; ++axis)
    {
      left = left & SeenAhead(nodes, all, axis, 1) & SeenBehind(nodes, all, axis, 1);
    }
    if (!left.Any())
    {
      break;
    }
    nodes = left;
  }
  return nodes;
}

/** A component of a part. */
struct Piece
{
  openvdb::Coord Origin;
  std::int32_t Size;
  LeafMask Nodes;
  openvdb::Coord Sample; // of the deepest nodes, the node nearest to the centre
  int Depth;

  Piece(const Component& component, const Block& block)
    : Origin(block.Origin)
    , Size(block.Size)
    , Nodes(component.Nodes)
  {
    const LeafMask deepest = FindDeepest(this->Nodes, this->Depth);
    this->Depth = this->Size > 8 ? this->Size : this->Depth;
    const int scale = this->Size / 8;
    int nearest = 3 * 64;
    deepest.ForEach(
      [&](int node)
      {
        const openvdb::Coord place(node >> 6, (node >> 3) & 7, node & 7);
        const openvdb::Coord off = place.offsetBy(-4);
        const int square = off[0] * off[0] + off[1] * off[1] + off[2] * off[2];
        if (square < nearest)
        {
          nearest = square;
          this->Sample =
            this->Origin + openvdb::Coord(scale * place[0], scale * place[1], scale * place[2]);
        }
      });
  }
};

class LatticePart : public TargetPart
{
public:
  LatticePart(const LatticeShape& shape, bool isHollow)
    : Hollow(isHollow)
  {
    this->Axes.Origin = shape.Origin;
    std::copy(shape.Axis, shape.Axis + 3, this->Axes.Axis);
  }

  void Add(const Component& component, const Block& block)
  {
    this->Pieces.emplace_back(component, block);
  }

  void SortByDepth()
  {
    std::stable_sort(this->Pieces.begin(), this->Pieces.end(),
      [](const Piece& a, const Piece& b) { return a.Depth > b.Depth; });
  }

  bool IsHollow() const override { return this->Hollow; }

  void ForEachSample(const PointVisitor& visit) const override
  {
    for (const Piece& piece : this->Pieces)
    {
      if (!this->Visit(piece.Sample, visit))
      {
        return;
      }
    }
  }

  /** Visits all nodes; in tiles larger than a leaf every eighth node along each axis. */
  void ForEachPoint(const PointVisitor& visit) const override
  {
    for (const Piece& piece : this->Pieces)
    {
      if (piece.Size > 8 ? !this->VisitTile(piece, visit) : !this->VisitLeaf(piece, visit))
      {
        return;
      }
    }
  }

private:
  bool Visit(const openvdb::Coord& node, const PointVisitor& visit) const
  {
    return visit(this->Axes.PlaceOf(node.asVec3d()).asPointer());
  }

  bool VisitLeaf(const Piece& piece, const PointVisitor& visit) const
  {
    bool goesOn = true;
    piece.Nodes.ForEach(
      [&](int node)
      {
        const openvdb::Coord place = piece.Origin.offsetBy(node >> 6, (node >> 3) & 7, node & 7);
        goesOn = goesOn && this->Visit(place, visit);
      });
    return goesOn;
  }

  bool VisitTile(const Piece& piece, const PointVisitor& visit) const
  {
    for (int x = 4; x < piece.Size; x += 8)
    {
      for (int y = 4; y < piece.Size; y += 8)
      {
        for (int z = 4; z < piece.Size; z += 8)
        {
          if (!this->Visit(piece.Origin.offsetBy(x, y, z), visit))
          {
            return false;
          }
        }
      }
    }
    return true;
  }

  bool Hollow;
  LatticeShape Axes; // without nodes
  std::vector<Piece> Pieces;
};

}

LatticeParts::LatticeParts(const LatticeShape& shape)
{
  Components components(shape.Inside);
  std::map<std::int32_t, std::unique_ptr<LatticePart>> parts; // by their roots
  for (std::size_t i = 1; i < components.Size(); ++i)
  {
    const std::int32_t root = components.FindRoot(static_cast<std::int32_t>(i));
    if (root != Unbounded)
    {
      std::unique_ptr<LatticePart>& part = parts[root];
      if (!part)
      {
        part = std::make_unique<LatticePart>(shape, !components[i].IsInside);
      }
      part->Add(components[i], components.BlockOf(components[i]));
    }
  }
  for (auto& [root, part] : parts)
  {
    part->SortByDepth();
    this->Parts.push_back(std::move(part));
  }
}

LatticeParts::~LatticeParts() = default;

void LatticeParts::ForEachPart(const PartVisitor& visit) const
{
  for (const std::unique_ptr<TargetPart>& part : this->Parts)
  {
    visit(*part);
  }
}

}
