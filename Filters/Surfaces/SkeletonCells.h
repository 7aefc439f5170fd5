// Finds the elements of a skeleton whose supports may contain a point, in a time that does not
// depend on the number of elements: each element is listed, in index order, in every cell of a
// uniform lattice that its support touches, so that a point reads one list. (Elements listed once,
// and 27 cells read and merged, would mean twice the candidates and a merge.)
//
// Elements of unlike size have lattices of their own, whose cells halve from one to the next; a
// point reads one list in each. A ball is listed at most 64 times, a long segment about 1000 times:
// memory is O(elements), however large or degenerate the extent.

#ifndef SkeletonCells_h
#define SkeletonCells_h

#include "InstructionSets.h"
#include "SkeletonLattice.h"

#include <vector>

namespace activesurface
{

// The support of an element; a ball if Start equals End. All numbers finite, radii > 0.
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

  // What is left to be looked at for one point in one lattice.
  struct Search
  {
    float Position[3]; // of the point, in cells from its cell's centre
    Index Start;
    Index Length;
    Index Done;

    bool IsOver() const { return this->Done == this->Length; }
  };

  static constexpr std::size_t MaximumLattices = 64;

  // bounds contain all capsules. Throws std::length_error for more elements than 32-bit lists can
  // hold. Keeps its memory from call to call.
  void Build(const std::vector<Capsule>& capsules, const double bounds[6]);

  std::size_t GetNumberOfLattices() const { return this->Lattices.size(); }

  // An element is found in one lattice.
  ACTIVE_ALWAYS_INLINE Search StartSearch(std::size_t lattice, const double x[3]) const;

  // The next elements, in ascending order, that may contain the point: all that do, and a few more.
  // Looks at `capacity` elements, at most HitsAtOnce, and returns the number of hits, which may be
  // 0 before the search is over.
  static constexpr std::size_t HitsAtOnce = 256;
  ACTIVE_ALWAYS_INLINE std::size_t TakeHits(
    Search& search, Index* hits, std::size_t capacity) const;

private:
  // Positions are clamped there, in cells: beyond what a ball reaches.
  static constexpr double FarAway = 16.0;

  // Without taper, and enlarged by what rounding may do to a coordinate.
  struct Piece
  {
    double Start[3];
    double Edge[3];
    double Radius;
  };

  // An element in a cell, with a ball that contains the support there: lengths in cells, position
  // from the cell's centre.
  struct Registration
  {
    Index Slot;
    float Ball[4]; // x y z radius^2
  };

  // The cells of a lattice that a ball may touch, along one axis.
  struct Span;

  void Measure(const std::vector<Capsule>& capsules, const double bounds[6]);
  void ChooseLattices(const std::vector<Capsule>& capsules);
  int ChooseLevel(const Capsule& capsule) const;
  void MakeSlots();
  void Register(Index element, const Capsule& capsule);
  void RegisterBall(
    Index element, const double centre[3], double radius, const SkeletonLattice& lattice);
  static Span GetSpan(const SkeletonLattice& lattice, int axis, double centre, double radius);
  Piece GetPiece(const Capsule& capsule, double from, double to) const;
  void RegisterPiece(Index element, const Piece& piece, const SkeletonLattice& lattice);
  static bool Touches(const Piece& piece, const SkeletonLattice& lattice, const Index cell[3]);
  void AddTo(std::size_t slot, Index element, const float ball[4]);
  void FillLists();

  double Origin[3];     // of all lattices
  double Slack;         // bounds the rounding of a coordinate
  double LargestRadius; // with Slack
  double FirstCellSize;
  std::vector<SkeletonLattice> Lattices; // coarse to fine, none empty
  std::vector<Index> ListStarts;         // per slot, and the end of the last
  std::vector<Index> Lists;
  std::vector<float> Balls; // 4 per entry of Lists: all x of a list, then all y, z, and radius^2

  // Of Build, kept for their memory.
  std::vector<int> LatticeOf;      // per element
  std::vector<Index> LastElements; // per slot: the last one registered, plus one; then a count
  std::vector<Registration> Registrations;
  std::vector<Index> RegistrationCounts; // per element
};

ACTIVE_ALWAYS_INLINE SkeletonCells::Search SkeletonCells::StartSearch(
  std::size_t lattice, const double x[3]) const
{
  Search search;
  Index cell[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    const double coordinate = this->Lattices[lattice].GetCoordinate(x[axis], axis);
    cell[axis] = SkeletonLattice::GetCell(coordinate);
    const double place = coordinate - cell[axis] - 0.5;
    search.Position[axis] = static_cast<float>(std::min(std::max(place, -FarAway), FarAway));
  }
  const std::size_t slot = this->Lattices[lattice].GetSlot(cell);
  search.Start = this->ListStarts[slot];
  search.Length = this->ListStarts[slot + 1] - search.Start;
  search.Done = 0;
  return search;
}

// Two loops: the first is for the vector unit, the second has no branch, as hits are unpredictable.
ACTIVE_ALWAYS_INLINE std::size_t SkeletonCells::TakeHits(
  Search& search, Index* hits, std::size_t capacity) const
{
  const Index length = search.Length;
  const Index looked = std::min(length - search.Done, static_cast<Index>(capacity));
  const float* ballX = this->Balls.data() + std::size_t(4) * search.Start + search.Done;
  const float* ballY = ballX + length;
  const float* ballZ = ballY + length;
  const float* radius2 = ballZ + length;
  const float x = search.Position[0];
  const float y = search.Position[1];
  const float z = search.Position[2];
  Index isHit[HitsAtOnce];
  for (Index i = 0; i < looked; ++i)
  {
    const float dx = ballX[i] - x;
    const float dy = ballY[i] - y;
    const float dz = ballZ[i] - z;
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
