/**
 * What ranks that advance a band together tell each other after a pass; see LeafOwners.h. Without
 * ranks nothing is done.
 *
 * A visit names what the pass has written for a leaf: visit(leaf, pass), which calls
 * pass(values, count) for each of its arrays. All ranks make the same calls with the same lists of
 * leaves, ascending.
 */
#ifndef LeafExchange_h
#define LeafExchange_h

#include "Leaves/LeafLists.h"
#include "Leaves/LeafTable.h"
#include "SharedResults.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <type_traits>
#include <vector>

namespace activesurface
{

/** Passes the values of some nodes of a leaf; ranks know which, of leaves beside their own. */
template <class Value, class Pass>
void PassNodes(Value* values, const LeafMask& nodes, Pass& pass)
{
  Value packed[512];
  Value* next = packed;
  if constexpr (std::is_same_v<Pass, ByteWriter>)
  {
    nodes.ForEach([&](int node) { *next++ = values[node]; });
  }
  pass(packed, static_cast<std::size_t>(nodes.Count()));
  if constexpr (std::is_same_v<Pass, ByteReader>)
  {
    nodes.ForEach([&](int node) { values[node] = *next++; });
  }
}

/** Tells each rank its leaves of toEach; those in fromEach are what it is told by each. */
template <class Visit>
void SwapLeaves(Agreement& ranks, const std::vector<LeafList>& toEach,
  const std::vector<LeafList>& fromEach, Visit&& visit)
{
  std::vector<Bytes> written(toEach.size());
  std::vector<std::size_t> sizes(toEach.size());
  for (std::size_t rank = 0; rank < toEach.size(); ++rank)
  {
    written[rank] = WriteResults(toEach[rank], visit);
    ByteCounter count;
    for (const std::int32_t i : fromEach[rank])
    {
      visit(static_cast<std::size_t>(i), count);
    }
    sizes[rank] = count.GetSize();
  }
  const std::vector<Bytes> received = ranks.Swap(written, sizes);
  for (std::size_t rank = 0; rank < toEach.size(); ++rank)
  {
    ByteReader read(received[rank]);
    for (const std::int32_t i : fromEach[rank])
    {
      visit(static_cast<std::size_t>(i), read);
    }
  }
}

/** Tells each rank the leaves beside its own. */
template <class Visit>
void TellNeighbours(const LeafTable& table, Visit&& visit)
{
  if (LeafOwners* ranks = table.GetRanks())
  {
    const LeafBorders& borders = ranks->GetBorders();
    SwapLeaves(ranks->GetAgreement(), borders.Own, borders.Others, visit);
  }
}

/** The same for some of the leaves. */
template <class Visit>
void TellNeighbours(const LeafTable& table, const LeafList& leaves, Visit&& visit)
{
  if (LeafOwners* ranks = table.GetRanks())
  {
    LeafBorders borders = ranks->GetBorders();
    for (int rank = 0; rank < ranks->GetSize(); ++rank)
    {
      borders.Own[rank] = Intersection(borders.Own[rank], leaves);
      borders.Others[rank] = Intersection(borders.Others[rank], leaves);
    }
    SwapLeaves(ranks->GetAgreement(), borders.Own, borders.Others, visit);
  }
}

/** Tells all ranks about so many results, each of which one rank has made. */
template <class OwnerOf, class Visit>
void TellResults(LeafOwners& ranks, std::size_t count, OwnerOf&& ownerOf, Visit&& visit)
{
  std::vector<std::size_t> own;
  for (std::size_t n = 0; n < count; ++n)
  {
    if (ownerOf(n) == ranks.GetRank())
    {
      own.push_back(n);
    }
  }
  const std::vector<Bytes> all = ranks.GetAgreement().Exchange(WriteResults(own, visit));
  std::vector<ByteReader> read(all.begin(), all.end());
  for (std::size_t n = 0; n < count; ++n)
  {
    if (ownerOf(n) != ranks.GetRank())
    {
      visit(n, read[ownerOf(n)]);
    }
  }
}

/** Each rank makes the results of its own leaves, which may not be there yet, and is told the
 * others. originOf(n): of a result's leaf; forEach(function): calls function(n) for all, as
 * parallel as they may be. Without ranks, all are made. */
template <class OriginOf, class ForEach, class Make, class Visit>
void ShareByOwners(LeafOwners* ranks, std::size_t count, OriginOf&& originOf, ForEach&& forEach,
  Make&& make, Visit&& visit)
{
  const auto ownerOf = [&](std::size_t n) { return ranks->FindOwner(originOf(n)); };
  forEach(
    [&](std::size_t n)
    {
      if (!ranks || ownerOf(n) == ranks->GetRank())
      {
        make(n);
      }
    });
  if (ranks)
  {
    TellResults(*ranks, count, ownerOf, visit);
  }
}

/** Tells all ranks about these leaves. */
template <class Visit>
void TellAll(const LeafTable& table, const LeafList& leaves, Visit&& visit)
{
  if (LeafOwners* ranks = table.GetRanks())
  {
    const auto leafOf = [&](std::size_t n) { return static_cast<std::size_t>(leaves[n]); };
    TellResults(
      *ranks, leaves.size(), [&](std::size_t n) { return ranks->GetOwner(leafOf(n)); },
      [&](std::size_t n, auto& pass) { visit(leafOf(n), pass); });
  }
}

/** Tells all ranks about all leaves. */
template <class Visit>
void TellAll(const LeafTable& table, Visit&& visit)
{
  if (table.GetRanks())
  {
    TellAll(table, table.FindAll([](std::size_t) { return true; }), visit);
  }
}

/** To be called before own values change: other ranks do not know them any more. */
inline void MarkValuesChanged(const LeafTable& table)
{
  if (table.GetRanks())
  {
    table.GetRanks()->SetValuesAreWhole(false);
  }
}

/** Runs a task on every rank: what goes wrong on one goes wrong on all. */
template <class Task>
void RunTogether(const LeafTable& table, Task&& task)
{
  if (table.GetRanks())
  {
    RunTogether(table.GetRanks()->GetAgreement(), task);
  }
  else
  {
    task();
  }
}

/** Whether it is so on one of the ranks at least. */
inline bool IsSoOnAny(const LeafTable& table, bool isSo)
{
  return table.GetRanks() ? table.GetRanks()->GetAgreement().IsSoOnAny(isSo) : isSo;
}

/** Sums of integers over the ranks. */
template <std::size_t Count>
std::array<std::int64_t, Count> SumOverRanks(
  const LeafTable& table, const std::array<std::int64_t, Count>& own)
{
  if (!table.GetRanks())
  {
    return own;
  }
  Bytes bytes;
  ByteWriter{ bytes }(own.data(), Count);
  std::array<std::int64_t, Count> sums{};
  for (const Bytes& of : table.GetRanks()->GetAgreement().Exchange(bytes))
  {
    std::array<std::int64_t, Count> numbers;
    ByteReader{ of }(numbers.data(), Count);
    std::transform(sums.begin(), sums.end(), numbers.begin(), sums.begin(), std::plus<>());
  }
  return sums;
}

/** How many the other ranks have, who has so many itself. */
inline std::size_t CountOfOthers(const LeafTable& table, std::size_t own)
{
  const auto count = static_cast<std::int64_t>(own);
  return static_cast<std::size_t>(SumOverRanks<1>(table, { count })[0] - count);
}

}

#endif
