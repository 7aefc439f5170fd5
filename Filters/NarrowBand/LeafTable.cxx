#include "LeafTable.h"

#include <utility>

namespace activesurface
{

namespace
{

std::size_t Hash(const openvdb::Coord& origin)
{
  const auto part = [](std::int32_t c) { return static_cast<std::uint64_t>(c >> 3); };
  std::uint64_t key = part(origin[0]) * 0x9e3779b97f4a7c15ull;
  key = (key ^ (key >> 29)) + part(origin[1]) * 0xbf58476d1ce4e5b9ull;
  key = (key ^ (key >> 31)) + part(origin[2]) * 0x94d049bb133111ebull;
  return static_cast<std::size_t>(key ^ (key >> 32));
}

}

void LeafTable::Rebuild(PotentialTree& tree)
{
  // The old index still finds the entries whose masks go on.
  this->Nodes.clear();
  tree.getNodes(this->Nodes);
  this->Previous.resize(this->Nodes.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, this->Nodes.size(), Grain),
    [this](const tbb::blocked_range<std::size_t>& range)
    {
      for (std::size_t i = range.begin(); i != range.end(); ++i)
      {
        const std::int32_t known = this->Find(this->Nodes[i]->origin());
        BandLeaf& leaf = this->Previous[i];
        leaf = known >= 0 ? this->Leaves[known] : BandLeaf();
        leaf.Leaf = this->Nodes[i];
        leaf.Value = this->Nodes[i]->buffer().data();
        leaf.Origin = this->Nodes[i]->origin();
      }
    });
  std::swap(this->Leaves, this->Previous);
  this->BuildIndex();
  this->FindNeighbours(tree);
}

void LeafTable::BuildIndex()
{
  std::size_t size = 64;
  while (size < 2 * this->Leaves.size())
  {
    size *= 2;
  }
  this->Index.assign(size, -1);
  for (std::size_t i = 0; i < this->Leaves.size(); ++i)
  {
    std::size_t slot = Hash(this->Leaves[i].Origin) & (size - 1);
    while (this->Index[slot] >= 0)
    {
      slot = (slot + 1) & (size - 1);
    }
    this->Index[slot] = static_cast<std::int32_t>(i);
  }
}

std::int32_t LeafTable::Find(const openvdb::Coord& origin) const
{
  if (this->Index.empty())
  {
    return NoLeafOutside;
  }
  const std::size_t last = this->Index.size() - 1;
  for (std::size_t slot = Hash(origin) & last; this->Index[slot] >= 0; slot = (slot + 1) & last)
  {
    if (this->Leaves[this->Index[slot]].Origin == origin)
    {
      return this->Index[slot];
    }
  }
  return NoLeafOutside;
}

void LeafTable::FindNeighbours(const PotentialTree& tree)
{
  this->ForEach(
    [&](std::size_t i)
    {
      BandLeaf& leaf = this->Leaves[i];
      for (int n = 0; n < 27; ++n)
      {
        const openvdb::Coord origin =
          leaf.Origin.offsetBy(8 * (n / 9 - 1), 8 * (n / 3 % 3 - 1), 8 * (n % 3 - 1));
        std::int32_t number = this->Find(origin);
        if (number < 0 && tree.getValue(origin) < 0.f)
        {
          number = NoLeafInside;
        }
        leaf.Neighbour[n] = number;
      }
    });
}

LeafTable::Place LeafTable::Offset(std::int32_t leaf, int node, int dx, int dy, int dz) const
{
  const int x = (node >> 6) + dx;
  const int y = ((node >> 3) & 7) + dy;
  const int z = (node & 7) + dz;
  const int number = NeighbourNumber((x >> 3), (y >> 3), (z >> 3));
  return { number == 13 ? leaf : this->Leaves[leaf].Neighbour[number],
    ((x & 7) << 6) | ((y & 7) << 3) | (z & 7) };
}

LeafMask NodesWithCrossing(const LeafTable& table, const BandLeaf& leaf)
{
  LeafMask nodes;
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::int32_t before = leaf.Neighbour[FaceNumber(axis, -1)];
    static const LeafMask nothing;
    const LeafMask& edges = before >= 0 ? table[before].Edge[axis] : nothing;
    nodes = nodes | leaf.Edge[axis] | SeenBehind(leaf.Edge[axis], edges, axis, 1);
  }
  return nodes;
}

}
