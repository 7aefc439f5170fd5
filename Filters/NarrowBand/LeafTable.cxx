#include "LeafTable.h"

#include <numeric>
#include <utility>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

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

/** Which of eight numbers are negative, one bit each. */
unsigned NegativeBits(const float* values)
{
#ifdef __SSE2__
  const __m128 zero = _mm_setzero_ps();
  const int low = _mm_movemask_ps(_mm_cmplt_ps(_mm_loadu_ps(values), zero));
  const int high = _mm_movemask_ps(_mm_cmplt_ps(_mm_loadu_ps(values + 4), zero));
  return static_cast<unsigned>(low | high << 4);
#else
  unsigned bits = 0;
  for (int z = 0; z < 8; ++z)
  {
    bits |= unsigned(values[z] < 0.f) << z;
  }
  return bits;
#endif
}

}

LeafMask InsideNodes(const float* values)
{
  LeafMask inside;
  for (int row = 0; row < 64; ++row)
  {
    inside.Word[row / 8] |= std::uint64_t(NegativeBits(values + 8 * row)) << (8 * (row % 8));
  }
  return inside;
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
        leaf.Inside = known >= 0 ? leaf.Inside : InsideNodes(leaf.Value);
      }
    });
  std::swap(this->Leaves, this->Previous);
  this->BuildIndex();
  this->FindNeighbours(tree);
  this->Moving.clear();
  this->Near = this->FindAll([](const BandLeaf& leaf) { return leaf.IsNear; });
}

void LeafTable::Move(LeafList leaves)
{
  for (const std::int32_t i : this->Near)
  {
    this->Leaves[i].IsNear = false;
  }
  this->Moving = std::move(leaves);
  this->Near = this->FindAround(this->Moving);
  for (const std::int32_t i : this->Near)
  {
    this->Leaves[i].IsNear = true;
  }
}

void LeafTable::MoveAll()
{
  LeafList all(this->Leaves.size());
  std::iota(all.begin(), all.end(), 0);
  this->Move(std::move(all));
}

LeafList LeafTable::FindAround(const LeafList& leaves) const
{
  if (leaves.size() == this->Leaves.size())
  {
    return leaves;
  }
  std::vector<char> isAround(this->Leaves.size());
  for (const std::int32_t i : leaves)
  {
    for (const std::int32_t n : this->Leaves[i].Neighbour)
    {
      if (n >= 0)
      {
        isAround[n] = 1;
      }
    }
  }
  LeafList around;
  for (std::size_t i = 0; i < isAround.size(); ++i)
  {
    if (isAround[i])
    {
      around.push_back(static_cast<std::int32_t>(i));
    }
  }
  return around;
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
