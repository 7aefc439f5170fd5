// Visits the elements that may reach a point, found in the cells of one lattice or of several.

#ifndef HitVisits_h
#define HitVisits_h

#include "SkeletonCells.h"

#include <algorithm>
#include <array>

namespace activesurface
{

// Hits of one lattice.
struct HitStream
{
  // Small enough for the streams of several lattices to fit into the L1 cache.
  static constexpr std::size_t Capacity = 32;

  SkeletonCells::Search Search;
  std::size_t Head;
  std::size_t Count;
  SkeletonCells::Index Hits[Capacity];

  // Returns true if there is a hit at Head.
  bool Refill(const SkeletonCells& cells)
  {
    while (this->Head == this->Count && !this->Search.IsOver())
    {
      this->Head = 0;
      this->Count = cells.TakeHits(this->Search, this->Hits, Capacity);
    }
    return this->Head < this->Count;
  }
};

template <class Visitor>
ACTIVE_ALWAYS_INLINE void VisitMergedHits(
  const SkeletonCells& cells, const SkeletonCells::Place& place, Visitor visit)
{
  std::array<HitStream, SkeletonCells::MaximumLattices> streams;
  std::array<HitStream*, SkeletonCells::MaximumLattices> open;
  auto end = open.begin();
  for (std::size_t lattice = 0; lattice < cells.GetNumberOfLattices(); ++lattice)
  {
    HitStream& stream = streams[lattice];
    stream.Search = cells.StartSearch(lattice, place);
    stream.Head = stream.Count = 0;
    *end = &stream;
    end += stream.Refill(cells) ? 1 : 0;
  }
  const auto isEarlier = [](const HitStream* a, const HitStream* b)
  { return a->Hits[a->Head] < b->Hits[b->Head]; };
  SkeletonCells::Index merged[SkeletonCells::HitsAtOnce];
  std::size_t count = 0;
  while (end != open.begin())
  {
    const auto first = std::min_element(open.begin(), end, isEarlier);
    HitStream& stream = **first;
    merged[count] = stream.Hits[stream.Head];
    ++stream.Head;
    ++count;
    if (!stream.Refill(cells))
    {
      --end;
      *first = *end;
    }
    if (count == SkeletonCells::HitsAtOnce || end == open.begin())
    {
      visit(merged, count);
      count = 0;
    }
  }
}

// Calls visit(hits, count) for all elements that may reach the place, in ascending order.
template <class Visitor>
ACTIVE_ALWAYS_INLINE void VisitHits(
  const SkeletonCells& cells, const SkeletonCells::Place& place, Visitor visit)
{
  if (cells.GetNumberOfLattices() > 1)
  {
    VisitMergedHits(cells, place, visit);
  }
  else if (cells.GetNumberOfLattices() == 1)
  {
    SkeletonCells::Index hits[SkeletonCells::HitsAtOnce];
    SkeletonCells::Search search = cells.StartSearch(0, place);
    while (!search.IsOver())
    {
      const std::size_t count = cells.TakeHits(search, hits, SkeletonCells::HitsAtOnce);
      visit(hits, count);
    }
  }
}

}

#endif
