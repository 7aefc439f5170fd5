// Groups points that share their cells, so that one search serves a whole group.

#ifndef SkeletonBatch_h
#define SkeletonBatch_h

#include "FinitePlaces.h"
#include "SkeletonCells.h"
#include "SkeletonKernel.h"

namespace activesurface
{

class SkeletonBatch
{
public:
  using Index = SkeletonCells::Index;

  static constexpr std::size_t Capacity = 256;

  // Sorts the finite points among up to Capacity points (x y z each).
  ACTIVE_ALWAYS_INLINE SkeletonBatch(
    const SkeletonCells& cells, std::size_t count, const double* points)
    : Finite(count, points)
  {
    std::size_t starts[Buckets + 1] = {};
    for (std::size_t i = 0; i < count; ++i)
    {
      const double* x = points + 3 * i;
      if (this->Finite[i])
      {
        cells.FindCell(x, this->Cells[i]);
        ++starts[this->BucketOf(i) + 1];
      }
    }
    for (std::size_t bucket = 0; bucket < Buckets; ++bucket)
    {
      starts[bucket + 1] += starts[bucket];
    }
    this->Usable = starts[Buckets];
    for (std::size_t i = 0; i < count; ++i)
    {
      if (this->Finite[i])
      {
        this->Order[starts[this->BucketOf(i)]++] = i;
      }
    }
  }

  // Calls visit(members, count) for each group. members are indices of points; count is at most
  // SkeletonLanes::Width.
  template <class Visitor>
  ACTIVE_ALWAYS_INLINE void ForEachGroup(Visitor visit) const
  {
    const std::size_t* first = this->Order;
    const std::size_t* const end = this->Order + this->Usable;
    while (first != end)
    {
      const std::size_t* last = first + 1;
      while (last != end && last - first < SkeletonLanes::Width && this->ShareCells(*first, *last))
      {
        ++last;
      }
      visit(first, static_cast<int>(last - first));
      first = last;
    }
  }

  // Points that are not finite are in no group.
  const FinitePlaces<Capacity>& GetFinite() const { return this->Finite; }

private:
  // Hash by the position in the block: the points of a batch rarely span more than a block.
  static constexpr std::size_t Buckets = std::size_t(1) << SkeletonLattice::BlockBits;

  ACTIVE_ALWAYS_INLINE std::size_t BucketOf(std::size_t i) const
  {
    const Index* cell = this->Cells[i];
    return SkeletonLattice::GetPlaceInBlock(cell[0], 0) |
      SkeletonLattice::GetPlaceInBlock(cell[1], 1) | SkeletonLattice::GetPlaceInBlock(cell[2], 2);
  }

  ACTIVE_ALWAYS_INLINE bool ShareCells(std::size_t i, std::size_t k) const
  {
    bool share = true;
    for (int axis = 0; axis < 3; ++axis)
    {
      share = share && this->Cells[i][axis] == this->Cells[k][axis] &&
        this->Cells[i][axis] != SkeletonLattice::LastCell;
    }
    return share;
  }

  const FinitePlaces<Capacity> Finite;
  std::size_t Usable;
  Index Cells[Capacity][3];
  std::size_t Order[Capacity];
};

}

#endif
