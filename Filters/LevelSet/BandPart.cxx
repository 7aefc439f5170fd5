#include "BandPart.h"

#include "Ranks/RankBytes.h"

#include <algorithm>
#include <utility>

namespace activesurface
{

namespace
{

template <class Value>
void AppendTo(std::vector<Value>& all, const std::vector<Value>& values)
{
  all.insert(all.end(), values.begin(), values.end());
}

struct RankCounts
{
  std::size_t Crossings = 0;
  std::size_t ActiveNodes = 0;
  SkinSums Sums;
  std::int64_t Counted = 0; //< vertices of the leaves that the rank counts
};

/** A leaf with its number of vertices, which Count replaces by the number of vertices before the
 * leaf in the range of the counting rank. */
struct CountedLeaf
{
  NodeIndex Origin;
  std::int64_t Vertices;
};

NodeIndex OriginOf(const BandLeaf& leaf)
{
  return { leaf.Origin[0], leaf.Origin[1], leaf.Origin[2] };
}

bool IsBefore(const BandPart::LeafVertices& a, const BandPart::LeafVertices& b)
{
  return a.Origin < b.Origin;
}

bool HasVertices(const LeafTable& table, std::size_t i)
{
  return !table.SummaryOf(i).IsForeign && table[i].Crossings > 0;
}

/** Numbers the vertices of all ranks in the order of the tree. Each rank counts the vertices of a
 * range of leaves; these leaves may belong to any rank. */
class VertexCount
{
public:
  /** Collective. Answer is collective too. */
  VertexCount(const LeafTable& table, const Domain& space)
    : Space(space)
    , Asked(static_cast<std::size_t>(space.GetRanks().GetSize()))
  {
    for (std::size_t i = 0; i < table.Size(); ++i)
    {
      if (HasVertices(table, i))
      {
        const NodeIndex origin = OriginOf(table[i]);
        this->Asked[this->CounterOf(origin)].push_back({ origin, table[i].Crossings });
      }
    }
    std::vector<Bytes> sent;
    std::transform(
      this->Asked.begin(), this->Asked.end(), std::back_inserter(sent), ToBytes<CountedLeaf>);
    for (const Bytes& bytes : space.GetRanks().Distribute(std::move(sent)))
    {
      this->Leaves.push_back(FromBytes<CountedLeaf>(bytes));
    }
    this->Count();
  }

  /** Number of vertices in the leaves that this rank counts. */
  std::int64_t GetSum() const { return this->Sum; }

  /** Returns the number of the first vertex of each own leaf that has vertices, in the table's
   * order. before: number of vertices that ranks below this rank count. */
  std::vector<std::int64_t> Answer(std::int64_t before)
  {
    std::vector<Bytes> answers;
    std::vector<std::size_t> sizes;
    for (std::vector<CountedLeaf>& leaves : this->Leaves)
    {
      std::vector<std::int64_t> firsts;
      std::transform(leaves.begin(), leaves.end(), std::back_inserter(firsts),
        [before](const CountedLeaf& leaf) { return before + leaf.Vertices; });
      answers.push_back(ToBytes(firsts));
    }
    for (const std::vector<CountedLeaf>& leaves : this->Asked)
    {
      sizes.push_back(leaves.size() * sizeof(std::int64_t));
    }
    std::vector<std::int64_t> all; // counters and their leaves follow the order of the tree
    for (const Bytes& bytes : this->Space.GetRanks().Distribute(std::move(answers), sizes))
    {
      AppendTo(all, FromBytes<std::int64_t>(bytes));
    }
    return all;
  }

private:
  std::size_t CounterOf(const NodeIndex& origin) const
  {
    return static_cast<std::size_t>(this->Space.CounterOf(origin));
  }

  /** Replaces the number of vertices of each leaf by the number of vertices before the leaf in this
   * rank's range. */
  void Count()
  {
    std::vector<CountedLeaf*> order;
    for (std::vector<CountedLeaf>& leaves : this->Leaves)
    {
      std::transform(leaves.begin(), leaves.end(), std::back_inserter(order),
        [](CountedLeaf& leaf) { return &leaf; });
    }
    std::sort(order.begin(), order.end(),
      [](const CountedLeaf* a, const CountedLeaf* b)
      { return IsBeforeInTree(a->Origin, b->Origin); });
    for (CountedLeaf* leaf : order)
    {
      this->Sum += std::exchange(leaf->Vertices, this->Sum);
    }
  }

  const Domain& Space;
  std::vector<std::vector<CountedLeaf>> Asked;  // own leaves, by the rank that counts them
  std::vector<std::vector<CountedLeaf>> Leaves; // leaves that this rank counts, by owner
  std::int64_t Sum = 0;
};

/** Sends the LeafVertices of own leaves to the ranks of neighbour leaves. Returns the LeafVertices
 * received, by origin. */
std::vector<BandPart::LeafVertices> SwapFirstVertices(const LeafTable& table, const BandPart& part)
{
  std::vector<std::vector<BandPart::LeafVertices>> toEach(
    static_cast<std::size_t>(part.GetRanks().GetSize()));
  auto first = part.FirstVertices.begin();
  std::vector<int> others;
  for (std::size_t i = 0; i < table.Size(); ++i)
  {
    if (!HasVertices(table, i))
    {
      continue;
    }
    const NodeIndex origin = OriginOf(table[i]);
    part.Space->ListOthersAround(origin, others);
    for (const int other : others)
    {
      toEach[static_cast<std::size_t>(other)].push_back({ origin, *first, table[i].Edge });
    }
    ++first;
  }
  std::vector<Bytes> sent;
  std::transform(
    toEach.begin(), toEach.end(), std::back_inserter(sent), ToBytes<BandPart::LeafVertices>);
  std::vector<BandPart::LeafVertices> foreign;
  for (const Bytes& bytes : part.GetRanks().Distribute(std::move(sent)))
  {
    AppendTo(foreign, FromBytes<BandPart::LeafVertices>(bytes));
  }
  std::sort(foreign.begin(), foreign.end(), IsBefore);
  return foreign;
}

}

std::shared_ptr<const BandPart> CountTogether(
  const LeafTable& table, const std::shared_ptr<const Domain>& space)
{
  auto part = std::make_shared<BandPart>();
  part->Space = space;
  RankCounts own;
  own.Crossings = table.Count([](const LeafSummary& leaf) { return leaf.Crossings; });
  own.ActiveNodes = table.Count([](const LeafSummary& leaf) { return leaf.ActiveNodes; });
  own.Sums = SumSkin(table);
  VertexCount vertices(table, *space);
  own.Counted = vertices.GetSum();
  SkinSums sums;
  std::int64_t before = 0;
  int rank = 0;
  for (const RankCounts& counts : part->GetRanks().ExchangeValue(own))
  {
    before += rank++ < part->GetRanks().GetRank() ? counts.Counted : 0;
    part->Crossings += counts.Crossings;
    part->ActiveNodes += counts.ActiveNodes;
    sums.Add(counts.Sums);
  }
  part->Measure = sums.Get();
  part->FirstVertices = vertices.Answer(before);
  part->Foreign = SwapFirstVertices(table, *part);
  return part;
}

namespace
{

/** Numbers the vertices of another rank's leaf. owners: the vertices that the owner has sent; null:
 * none, so that all vertices get -1. Edges that are crossed only in this rank's copy, next to a
 * missing leaf, get -1. */
void NumberForeign(
  const BandLeaf& leaf, const BandPart::LeafVertices* owners, std::vector<std::int64_t>& numbers)
{
  std::int64_t next = owners ? owners->First : -1;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    std::array<std::int64_t, 512> ofNode;
    ofNode.fill(-1);
    if (owners)
    {
      owners->Edge[axis].ForEach([&](int node) { ofNode[node] = next++; });
    }
    leaf.Edge[axis].ForEach([&](int node) { numbers.push_back(ofNode[node]); });
  }
}

}

std::vector<std::int64_t> NumberVertices(const LeafTable& table, const BandPart* part)
{
  std::vector<std::int64_t> numbers;
  std::size_t own = 0;
  for (std::size_t i = 0; i < table.Size(); ++i)
  {
    if (table.SummaryOf(i).IsForeign)
    {
      const BandPart::LeafVertices wanted = { OriginOf(table[i]), 0, {} };
      const auto found =
        std::lower_bound(part->Foreign.begin(), part->Foreign.end(), wanted, IsBefore);
      const bool isKnown = found != part->Foreign.end() && found->Origin == wanted.Origin;
      NumberForeign(table[i], isKnown ? &*found : nullptr, numbers);
      continue;
    }
    const auto count = static_cast<std::int64_t>(numbers.size());
    const std::int64_t first = part && HasVertices(table, i) ? part->FirstVertices[own++] : count;
    for (int k = 0; k < table[i].Crossings; ++k)
    {
      numbers.push_back(first + k);
    }
  }
  return numbers;
}

}
