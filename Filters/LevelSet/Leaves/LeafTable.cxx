#include "Leaves/LeafTable.h"

#include "Ranks/Domain.h"

#include <algorithm>
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

/** Returns one bit for each of eight numbers: set if the number is negative. */
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

bool IsBeforeInTree(const openvdb::Coord& a, const openvdb::Coord& b)
{
  return IsBeforeInTree(NodeIndex{ a[0], a[1], a[2] }, NodeIndex{ b[0], b[1], b[2] });
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

BandLeaf::BandLeaf(PotentialLeaf& leaf)
  : Value(leaf.buffer().data())
  , Leaf(&leaf)
  , Origin(leaf.origin())
  , Inside(InsideNodes(leaf.buffer().data()))
{
}

void LeafTable::Rebuild(PotentialTree& tree)
{
  // Until BuildIndex, Find searches the old entries.
  std::vector<PotentialLeaf*> nodes;
  tree.getNodes(nodes);
  std::vector<BandLeaf> leaves;
  leaves.reserve(nodes.size() + nodes.size() / 8); // avoids reallocation while a surface grows
  leaves.resize(nodes.size());
  std::vector<LeafSummary> summaries;
  summaries.reserve(leaves.capacity());
  summaries.resize(nodes.size());
  ForRange(nodes.size(),
    [&](std::size_t i)
    {
      const std::int32_t known = this->Find(nodes[i]->origin());
      leaves[i] = known >= 0 ? this->Leaves[known] : BandLeaf(*nodes[i]);
      summaries[i] = known >= 0 ? this->Summaries[known] : LeafSummary();
      summaries[i].IsForeign = this->IsForeign(nodes[i]->origin());
    });
  std::swap(this->Leaves, leaves);
  std::swap(this->Summaries, summaries);
  this->Sorted = this->Leaves.size();
  this->BuildIndex();
  ForRange(this->Leaves.size(), [&](std::size_t i) { this->FindNeighbours(i, tree); });
}

LeafList LeafTable::Add(const std::vector<openvdb::Coord>& origins, PotentialTree& tree)
{
  LeafList added;
  for (const openvdb::Coord& origin : origins)
  {
    if (this->Find(origin) >= 0)
    {
      continue;
    }
    const std::size_t i = this->Leaves.size();
    added.push_back(static_cast<std::int32_t>(i));
    this->Summaries.resize(i + 1); // first: if memory runs out, no leaf lacks a summary
    this->Summaries[i].IsForeign = this->IsForeign(origin);
    this->Leaves.emplace_back(*tree.touchLeaf(origin));
    this->AddToIndex(i);
    this->FindNeighbours(i, tree);
    for (int n = 0; n < 27; ++n)
    {
      const std::int32_t neighbour = this->Leaves[i].Neighbour[n];
      if (neighbour >= 0)
      {
        this->Leaves[neighbour].Neighbour[26 - n] = static_cast<std::int32_t>(i);
      }
    }
  }
  return added;
}

LeafList LeafTable::FindTreeOrder() const
{
  LeafList order(this->Leaves.size());
  std::iota(order.begin(), order.end(), 0);
  const auto added = order.begin() + static_cast<std::ptrdiff_t>(this->Sorted);
  const auto isBefore = [this](std::int32_t a, std::int32_t b)
  { return IsBeforeInTree(this->Leaves[a].Origin, this->Leaves[b].Origin); };
  std::sort(added, order.end(), isBefore);
  std::inplace_merge(order.begin(), added, order.end(), isBefore);
  return order;
}

LeafList LeafTable::FindAround(const LeafList& leaves) const
{
  if (leaves.empty() || leaves.size() == this->Leaves.size())
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

bool LeafTable::IsForeign(const openvdb::Coord& origin) const
{
  return this->Space && !this->Space->IsOwn({ origin[0], origin[1], origin[2] });
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
    this->AddToIndex(i);
  }
}

void LeafTable::AddToIndex(std::size_t i)
{
  if (this->Index.size() < this->Leaves.size() + this->Leaves.size() / 2)
  {
    this->BuildIndex();
    return;
  }
  const std::size_t last = this->Index.size() - 1;
  std::size_t slot = Hash(this->Leaves[i].Origin) & last;
  while (this->Index[slot] >= 0)
  {
    slot = (slot + 1) & last;
  }
  this->Index[slot] = static_cast<std::int32_t>(i);
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

void LeafTable::FindNeighbours(std::size_t i, const PotentialTree& tree)
{
  BandLeaf& leaf = this->Leaves[i];
  for (int n = 0; n < 27; ++n)
  {
    const openvdb::Coord origin = leaf.OriginOf(n);
    std::int32_t number = this->Find(origin);
    if (number < 0 && tree.getValue(origin) < 0.f)
    {
      number = NoLeafInside;
    }
    leaf.Neighbour[n] = number;
  }
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
