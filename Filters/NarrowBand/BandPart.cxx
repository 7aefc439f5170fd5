#include "BandPart.h"

#include "RankBytes.h"

#include <algorithm>

namespace activesurface
{

namespace
{

struct RankCounts
{
  std::size_t Crossings = 0;
  std::size_t ActiveNodes = 0;
  SkinSums Sums;
};

NodeIndex OriginOf(const BandLeaf& leaf)
{
  return { leaf.Origin[0], leaf.Origin[1], leaf.Origin[2] };
}

bool IsBefore(const BandPart::LeafVertices& a, const BandPart::LeafVertices& b)
{
  return a.Origin < b.Origin;
}

/** Sends the first vertices of this rank's leaves to the ranks around; returns theirs. */
std::vector<BandPart::LeafVertices> SwapFirstVertices(const LeafTable& table, const BandPart& part)
{
  std::vector<std::vector<BandPart::LeafVertices>> toEach(
    static_cast<std::size_t>(part.GetRanks().GetSize()));
  std::int64_t first = part.FirstVertex;
  std::vector<int> others;
  for (std::size_t i = 0; i < table.Size(); ++i)
  {
    if (table.SummaryOf(i).IsForeign || table[i].Crossings == 0)
    {
      continue;
    }
    const NodeIndex origin = OriginOf(table[i]);
    others.clear();
    part.Space->ListOthersAround(origin, others);
    for (const int other : others)
    {
      toEach[static_cast<std::size_t>(other)].push_back({ origin, first, table[i].Edge });
    }
    first += table[i].Crossings;
  }
  std::vector<Bytes> sent;
  std::transform(
    toEach.begin(), toEach.end(), std::back_inserter(sent), ToBytes<BandPart::LeafVertices>);
  std::vector<BandPart::LeafVertices> foreign;
  for (const Bytes& bytes : part.GetRanks().Distribute(sent))
  {
    const auto leaves = FromBytes<BandPart::LeafVertices>(bytes);
    foreign.insert(foreign.end(), leaves.begin(), leaves.end());
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
  SkinSums sums;
  int rank = 0;
  for (const RankCounts& counts : part->GetRanks().ExchangeValue(own))
  {
    part->FirstVertex +=
      rank++ < part->GetRanks().GetRank() ? static_cast<std::int64_t>(counts.Crossings) : 0;
    part->Crossings += counts.Crossings;
    part->ActiveNodes += counts.ActiveNodes;
    sums.Add(counts.Sums);
  }
  part->Measure = sums.Get();
  part->Foreign = SwapFirstVertices(table, *part);
  return part;
}

namespace
{

/** Numbers vertices on the edges that the owner of a leaf has: others here end at missing leaves.
 */
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
  std::int64_t own = part ? part->FirstVertex : 0;
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
    for (int k = 0; k < table[i].Crossings; ++k)
    {
      numbers.push_back(own++);
    }
  }
  return numbers;
}

}
