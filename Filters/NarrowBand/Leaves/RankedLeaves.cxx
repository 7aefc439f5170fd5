#include "Leaves/RankedLeaves.h"

#include "Leaves/LeafExchange.h"
#include "Leaves/LeafLists.h"
#include "Leaves/LeafTable.h"
#include "MortonOrder.h"
#include "Ranks/LeafRanges.h"

#include <algorithm>

namespace activesurface
{

namespace
{

/** What the passes over the nodes of a leaf cost, in what a crossing costs. */
constexpr std::size_t CostOfNodes = 64;

}

bool AreLeavesInOrder(const openvdb::Coord& a, const openvdb::Coord& b)
{
  return IsBeforeInMortonOrder(a.data(), b.data());
}

RankedLeaves::RankedLeaves(Agreement& ranks, const LeafTable& table)
  : LeafOwners(ranks)
{
  this->ShareAll(table);
  this->FindOwners(table);
  this->FindBorders(table);
}

RankedLeaves::RankedLeaves(Agreement& ranks, const std::vector<openvdb::Coord>& origins)
  : LeafOwners(ranks)
{
  const RankRanges ranges{ origins.size(), static_cast<std::size_t>(this->GetSize()) };
  for (int rank = 0; rank < this->GetSize(); ++rank)
  {
    const std::size_t first = ranges.FirstOf(static_cast<std::size_t>(rank));
    if (first < ranges.FirstOf(static_cast<std::size_t>(rank) + 1))
    {
      this->FirstOrigins.push_back(origins[first]);
      this->OwnersOfRanges.push_back(rank);
    }
  }
}

void RankedLeaves::ShareAll(const LeafTable& table)
{
  LeafList order = table.FindAll([](std::size_t) { return true; });
  std::sort(order.begin(), order.end(),
    [&table](std::int32_t a, std::int32_t b)
    { return AreLeavesInOrder(table[a].Origin, table[b].Origin); });
  std::vector<std::size_t> costsBefore(1, 0);
  for (const std::int32_t i : order)
  {
    costsBefore.push_back(
      costsBefore.back() + CostOfNodes + static_cast<std::size_t>(table[i].Crossings));
  }
  const std::vector<std::size_t> first = ShareLeaves(costsBefore, this->GetSize());
  for (int rank = 0; rank < this->GetSize(); ++rank)
  {
    if (first[rank] < first[rank + 1])
    {
      this->FirstOrigins.push_back(table[order[first[rank]]].Origin);
      this->OwnersOfRanges.push_back(rank);
    }
  }
}

/** The first rank has what is before all of them. */
int RankedLeaves::FindOwner(const openvdb::Coord& origin) const
{
  const auto after = std::upper_bound(
    this->FirstOrigins.begin(), this->FirstOrigins.end(), origin, AreLeavesInOrder);
  const auto range = std::max<std::ptrdiff_t>(after - this->FirstOrigins.begin() - 1, 0);
  return this->OwnersOfRanges.empty() ? 0 : this->OwnersOfRanges[static_cast<std::size_t>(range)];
}

void RankedLeaves::Renumber(LeafTable& table)
{
  this->Owners.clear();
  this->Slots = LeafSlots();
  this->FindOwners(table);
  this->FindBorders(table);
  this->TellBorders(table, this->Borders);
}

void RankedLeaves::AddLeaves(LeafTable& table)
{
  const LeafBorders before = this->Borders;
  this->FindOwners(table);
  this->FindBorders(table);
  LeafBorders added = this->Borders;
  for (std::size_t rank = 0; rank < before.Own.size(); ++rank)
  {
    added.Own[rank] = Without(added.Own[rank], before.Own[rank]);
    added.Others[rank] = Without(added.Others[rank], before.Others[rank]);
  }
  this->TellBorders(table, added);
}

void RankedLeaves::FindOwners(const LeafTable& table)
{
  for (std::size_t i = this->Owners.size(); i < table.Size(); ++i)
  {
    this->Owners.push_back(this->FindOwner(table[i].Origin));
  }
}

/** What passes read of leaves beside their own. */
void RankedLeaves::TellBorders(LeafTable& table, const LeafBorders& borders)
{
  SwapLeaves(this->GetAgreement(), borders.Own, borders.Others,
    [&table](std::size_t i, auto& pass)
    {
      BandLeaf& leaf = table[i];
      pass(leaf.Value, 512);
      pass(&leaf.Inside, 1);
      pass(&leaf.Active, 1);
      pass(leaf.UpToLayer.data(), leaf.UpToLayer.size());
      pass(leaf.Edge.data(), leaf.Edge.size());
      pass(leaf.CrossingsBefore.data(), leaf.CrossingsBefore.size());
    });
}

void RankedLeaves::FindBorders(const LeafTable& table)
{
  this->Borders.Own.assign(this->GetSize(), {});
  this->Borders.Others.assign(this->GetSize(), {});
  std::vector<char> isBeside(table.Size());
  for (std::size_t i = 0; i < table.Size(); ++i)
  {
    for (const std::int32_t n : table[i].Neighbour)
    {
      if (!this->IsOwn(i) || n < 0 || this->IsOwn(static_cast<std::size_t>(n)))
      {
        continue;
      }
      const int rank = this->GetOwner(static_cast<std::size_t>(n));
      LeafList& own = this->Borders.Own[rank];
      if (own.empty() || own.back() != static_cast<std::int32_t>(i))
      {
        own.push_back(static_cast<std::int32_t>(i));
      }
      isBeside[n] = 1;
    }
  }
  for (std::size_t i = 0; i < table.Size(); ++i)
  {
    if (isBeside[i])
    {
      this->Borders.Others[this->GetOwner(i)].push_back(static_cast<std::int32_t>(i));
    }
  }
  this->FindSlots(table);
}

void RankedLeaves::FindSlots(const LeafTable& table)
{
  this->Slots.Resize(table.Size());
  for (std::size_t i = 0; i < table.Size(); ++i)
  {
    if (this->IsOwn(i))
    {
      this->Slots.Give(i);
    }
  }
  for (const LeafList& others : this->Borders.Others)
  {
    for (const std::int32_t i : others)
    {
      this->Slots.Give(static_cast<std::size_t>(i));
    }
  }
}

}
