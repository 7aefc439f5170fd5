// Finds the elements of a skeleton whose supports may contain a point. The time does not depend on
// the number of elements. Each element is listed, in index order, in every cell of a uniform
// lattice that its support touches, so a point reads one list. (Listing elements once, and merging
// 27 cells for a point, would double the candidates and need a merge.)
//
// Elements of different sizes have separate lattices, each with cells half as wide as those of the
// previous one. A point reads one list in each lattice. A ball is listed at most 27 times, a long
// segment a few hundred times. Memory is O(elements), however large or degenerate the extent.

#ifndef SkeletonCells_h
#define SkeletonCells_h

#include "InstructionSets.h"
#include "SkeletonLattice.h"

#include <vector>

namespace activesurface
{

// Support of an element; a ball if Start equals End. All numbers are finite, radii > 0.
struct Capsule
{
  double Start[3];
  double End[3];
  double StartRadius;
  double EndRadius;
};

class SkeletonCells
{
public:
  using Index = std::uint32_t;

  // A point, or a box around several points in one cell of each lattice.
  struct Place
  {
    double Low[3];
    double High[3];
  };

  // State of the search for one place in one lattice.
  struct Search
  {
    float Low[3]; // of the place, in cells from its cell's centre
    float High[3];
    Index Start;
    Index Length;
    Index Done;

    bool IsOver() const { return this->Done == this->Length; }
  };

  static constexpr std::size_t MaximumLattices = 64;

  // bounds contain all capsules. Throws std::length_error for more elements than 32-bit lists can
  // hold. Keeps allocated memory from call to call.
  void Build(const std::vector<Capsule>& capsules, const double bounds[6]);

  std::size_t GetNumberOfLattices() const { return this->Lattices.size(); }

  // Finds the cell of a point in the finest lattice. Points that share this cell share those of all
  // lattices, whose cells consist of finer ones. Cells at an end are an exception (see
  // SkeletonLattice::LastCell).
  ACTIVE_ALWAYS_INLINE void FindCell(const double x[3], Index cell[3]) const;

  // Each element is in one lattice.
  ACTIVE_ALWAYS_INLINE Search StartSearch(std::size_t lattice, const Place& place) const;

  // Finds the next elements, in ascending order, that touch the place, and a few more. Tests
  // `capacity` elements, at most HitsAtOnce. Returns the number of hits, which may be 0 before the
  // search is over.
  static constexpr std::size_t HitsAtOnce = 256;
  ACTIVE_ALWAYS_INLINE std::size_t TakeHits(
    Search& search, Index* hits, std::size_t capacity) const;

private:
  // Offsets are clamped to this many cells, which no ball reaches.
  static constexpr double FarAway = 16.0;

  // A piece without taper, enlarged by the rounding error of a coordinate.
  struct Piece
  {
    double Start[3];
    double Edge[3];
    double Radius;
  };

  // An element in a cell, with a ball that contains the support there. Lengths are in cells,
  // positions relative to the cell's centre.
  struct Registration
  {
    Index Slot;
    Index Element;
    float Ball[4]; // x y z radius^2
  };

  // Registrations of consecutive elements, by range of slots: ranges are filled in parallel.
  using Chunk = std::vector<std::vector<Registration>>;

  // Cells of a lattice that a ball may touch, along one axis.
  struct Span;

  void Measure(const std::vector<Capsule>& capsules, const double bounds[6]);
  void ChooseLattices(const std::vector<Capsule>& capsules);
  int ChooseLevel(const Capsule& capsule) const;
  void MakeSlots();
  void RegisterAll(const std::vector<Capsule>& capsules);
  void Register(Index element, const Capsule& capsule, Chunk& chunk) const;
  void RegisterBall(Index element, const double centre[3], double radius,
    const SkeletonLattice& lattice, Chunk& chunk) const;
  static Span GetSpan(const SkeletonLattice& lattice, int axis, double centre, double radius);
  Piece GetPiece(const Capsule& capsule, double from, double to) const;
  void RegisterPiece(
    Index element, const Piece& piece, const SkeletonLattice& lattice, Chunk& chunk) const;
  static bool Touches(const Piece& piece, const SkeletonLattice& lattice, const Index cell[3]);
  void AddTo(Chunk& chunk, std::size_t slot, Index element, const float ball[4]) const;
  void FillLists();
  void FillRange(std::size_t range);

  double Origin[3];     // of all lattices
  double Slack;         // bound on the rounding error of a coordinate
  double LargestRadius; // including Slack
  double FirstCellSize;
  std::vector<SkeletonLattice> Lattices; // coarse to fine, none empty
  std::vector<Index> ListStarts;         // per slot, and the end of the last
  std::vector<Index> Lists;
  std::vector<float> Balls; // 4 per entry of Lists: all x of a list, then all y, z, and radius^2

  // Temporaries of Build, kept to reuse their memory.
  std::vector<int> LatticeOf; // per element
  std::vector<Chunk> Chunks;
  int BitsOfRange = 0;                  // bits of a slot's index within its range
  std::vector<std::size_t> RangeStarts; // of the ranges' lists, and the end of the last
  std::vector<Index> Filled;            // per slot
};

ACTIVE_ALWAYS_INLINE void SkeletonCells::FindCell(const double x[3], Index cell[3]) const
{
  for (int axis = 0; axis < 3; ++axis)
  {
    cell[axis] = this->Lattices.empty()
      ? 0
      : SkeletonLattice::GetCell(this->Lattices.back().GetCoordinate(x[axis], axis));
  }
}

ACTIVE_ALWAYS_INLINE SkeletonCells::Search SkeletonCells::StartSearch(
  std::size_t lattice, const Place& place) const
{
  Search search;
  Index cell[3];
  const auto fromCentre = [&cell](double coordinate, int axis) ACTIVE_INLINED
  {
    const double offset = coordinate - cell[axis] - 0.5;
    return static_cast<float>(std::min(std::max(offset, -FarAway), FarAway));
  };
  for (int axis = 0; axis < 3; ++axis)
  {
    const double low = this->Lattices[lattice].GetCoordinate(place.Low[axis], axis);
    const double high = this->Lattices[lattice].GetCoordinate(place.High[axis], axis);
    cell[axis] = SkeletonLattice::GetCell(low);
    search.Low[axis] = fromCentre(low, axis);
    search.High[axis] = fromCentre(high, axis);
  }
  const std::size_t slot = this->Lattices[lattice].GetSlot(cell);
  search.Start = this->ListStarts[slot];
  search.Length = this->ListStarts[slot + 1] - search.Start;
  search.Done = 0;
  return search;
}

// The first loop is vectorised. The second has no branch, because hits are unpredictable.
ACTIVE_ALWAYS_INLINE std::size_t SkeletonCells::TakeHits(
  Search& search, Index* hits, std::size_t capacity) const
{
  const Index length = search.Length;
  const Index looked = std::min(length - search.Done, static_cast<Index>(capacity));
  const float* ballX = this->Balls.data() + std::size_t(4) * search.Start + search.Done;
  const float* ballY = ballX + length;
  const float* ballZ = ballY + length;
  const float* radius2 = ballZ + length;
  const Search at = search;
  const auto gap = [](float low, float high, float centre) ACTIVE_INLINED
  { return std::max(std::max(low - centre, centre - high), 0.f); };
  Index isHit[HitsAtOnce];
  for (Index i = 0; i < looked; ++i)
  {
    const float dx = gap(at.Low[0], at.High[0], ballX[i]);
    const float dy = gap(at.Low[1], at.High[1], ballY[i]);
    const float dz = gap(at.Low[2], at.High[2], ballZ[i]);
    isHit[i] = dx * dx + dy * dy + dz * dz < radius2[i] ? 1 : 0;
  }
  const Index* list = this->Lists.data() + search.Start + search.Done;
  std::size_t count = 0;
  for (Index i = 0; i < looked; ++i)
  {
    hits[count] = list[i];
    count += isHit[i];
  }
  search.Done += looked;
  return count;
}

}

#endif
