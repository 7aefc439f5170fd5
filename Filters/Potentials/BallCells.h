// Finds the balls that may contain a point. Each ball is listed once, in the cell of its centre,
// and a point searches the cells around it. The memory is a few numbers for each ball.
//
// Cells are cubes on a lattice through the origin. A ball lies in cells at least as wide as its
// radius: of the requested size, or a power of two larger or smaller. A block is four cells along
// each axis and is found by its coordinates; blocks without balls are not stored.

#ifndef BallCells_h
#define BallCells_h

#include "BlockTable.h"
#include "InstructionSets.h"
#include "UnsetVector.h"
#include "vtkActivePotentialsModule.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace activesurface
{

class VTKACTIVEPOTENTIALS_EXPORT BallCells
{
public:
  using Index = std::uint32_t;
  using Coordinate = BlockTable::Coordinate; // of a cell, along an axis

  // Numbers have to be finite, and the radius > 0.
  struct Ball
  {
    double Centre[3];
    double Radius;
  };

  // A point, or a box around several points.
  struct Place
  {
    double Low[3];
    double High[3];
  };

  // Keeps allocated memory. Throws std::length_error for more balls than 32-bit lists can hold.
  void Build(const UnsetVector<Ball>& balls, double cellSize);

  // Ball indices, ordered by cell. Hits are positions in this list.
  const UnsetVector<Index>& GetOrder() const { return this->Order; }

  // Returns the requested size.
  double GetCellSize() const { return this->CellSize; }

  // Bounding box of all balls: xmin xmax ymin ... Undefined without balls.
  const double* GetBounds() const { return this->Bounds; }

  // Largest extent of a query box [length].
  double GetGroupSize() const { return this->GroupSize; }

  static constexpr std::size_t HitsAtOnce = 256;

  // Calls visit(hits, count) for all balls that touch the place, and a few more. The order is by
  // cell, then by index, and does not depend on other balls.
  template <class Visitor>
  ACTIVE_ALWAYS_INLINE void VisitHits(const Place& place, Visitor visit) const;

private:
  static constexpr Coordinate FarthestCell = Coordinate(1) << 50;
  static constexpr double Farthest = 2.0 * static_cast<double>(FarthestCell);
  static constexpr std::size_t CellsPerBlock = 64;
  // Offsets are clamped to this many cells, which no ball reaches.
  static constexpr double FarAway = 32.0;
  // Relative rounding error of a coordinate, and error of a float within FarAway.
  static constexpr double Slack = 32.0 * std::numeric_limits<double>::epsilon();
  static constexpr double FloatMargin = 1e-5;
  static constexpr float Everywhere = std::numeric_limits<float>::infinity();

  // Cells of one size.
  struct Level
  {
    int Doublings; // of the requested size
    double InverseSize;
    double Reach; // the largest radius
  };

  // Cells around a place, and the place relative to one of their blocks.
  struct View
  {
    Coordinate First[3];
    Coordinate Last[3];
    double At[2][3]; // low and high, in cells
    float Reach2;    // in cells, squared

    float Low[3]; // in cells from the block's corner
    float High[3];
    int Begin[3]; // cells of the block
    int End[3];
  };

  ACTIVE_ALWAYS_INLINE static Coordinate GetCell(double coordinate);
  // Returns true for a cell at either end, which contains all points beyond.
  static bool IsLast(Coordinate cell) { return cell <= -FarthestCell || cell >= FarthestCell; }
  ACTIVE_ALWAYS_INLINE static float Clamp(double offset);
  ACTIVE_ALWAYS_INLINE static float GetSquare(double radius);
  ACTIVE_ALWAYS_INLINE static View LookAround(const Place& place, const Level& level);
  ACTIVE_ALWAYS_INLINE static void LookFrom(const Coordinate block[3], View& view);
  ACTIVE_ALWAYS_INLINE static float GetGap(const View& view, int axis, int cell);
  template <class Visitor>
  ACTIVE_ALWAYS_INLINE void VisitLevel(std::size_t number, const Place& place, Visitor visit) const;
  template <class Visitor>
  ACTIVE_ALWAYS_INLINE void VisitBlock(Index block, const View& view, Visitor visit) const;
  template <class Visitor>
  ACTIVE_ALWAYS_INLINE void VisitRow(Index begin, Index end, const View& view, Visitor visit) const;

  struct Sizes;
  void Measure(const UnsetVector<Ball>& balls);
  Sizes MeasurePiece(const UnsetVector<Ball>& balls, std::size_t begin, std::size_t end) const;
  int FindDoublings(double radius) const;
  std::size_t FindLevel(double radius) const;
  void FindSlots(const UnsetVector<Ball>& balls);
  void FindSlotsOf(const UnsetVector<Ball>& balls, std::size_t begin, std::size_t end);
  void SortBySlots();
  void FillBalls(const UnsetVector<Ball>& balls);
  void FillBall(std::size_t k, const Ball& ball, const BlockTable::Block& block);

  double CellSize = 1.0;
  double GroupSize = 1.0;
  double Bounds[6];
  std::vector<Level> Levels; // coarse to fine
  BlockTable Blocks;
  std::vector<Index> Starts; // of the balls of each cell of each block, z fastest, and the end
  UnsetVector<Index> Order;
  std::array<UnsetVector<float>, 4> Columns; // of the balls in order: x y z in the block, r^2

  // Temporaries of Build, kept to reuse their memory.
  UnsetVector<std::size_t> Slots; // of the balls
  std::vector<BlockTable> Chunks;
};

ACTIVE_ALWAYS_INLINE BallCells::Coordinate BallCells::GetCell(double coordinate)
{
  constexpr auto farthest = static_cast<double>(FarthestCell);
  const double kept = std::min(std::max(coordinate, -farthest), farthest);
  const auto cell = static_cast<Coordinate>(kept);
  return cell - (static_cast<double>(cell) > kept ? 1 : 0);
}

ACTIVE_ALWAYS_INLINE float BallCells::Clamp(double offset)
{
  return static_cast<float>(std::min(std::max(offset, -FarAway), FarAway));
}

ACTIVE_ALWAYS_INLINE float BallCells::GetSquare(double radius)
{
  return static_cast<float>(radius * radius * (1.0 + FloatMargin) + FloatMargin);
}

template <class Visitor>
ACTIVE_ALWAYS_INLINE void BallCells::VisitHits(const Place& place, Visitor visit) const
{
  for (std::size_t level = 0; level < this->Levels.size(); ++level)
  {
    this->VisitLevel(level, place, visit);
  }
}

template <class Visitor>
ACTIVE_ALWAYS_INLINE void BallCells::VisitLevel(
  std::size_t number, const Place& place, Visitor visit) const
{
  View view = LookAround(place, this->Levels[number]);
  Coordinate block[3];
  for (block[0] = view.First[0] >> 2; block[0] <= view.Last[0] >> 2; ++block[0])
  {
    for (block[1] = view.First[1] >> 2; block[1] <= view.Last[1] >> 2; ++block[1])
    {
      for (block[2] = view.First[2] >> 2; block[2] <= view.Last[2] >> 2; ++block[2])
      {
        const Index found =
          this->Blocks.Find({ { block[0], block[1], block[2] }, static_cast<int>(number) });
        if (found != BlockTable::None)
        {
          LookFrom(block, view);
          this->VisitBlock(found, view, visit);
        }
      }
    }
  }
}

// A place and a reach span at most three cells, and slightly more if rounding is coarse.
ACTIVE_ALWAYS_INLINE BallCells::View BallCells::LookAround(const Place& place, const Level& level)
{
  View view;
  double most = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto clamp = [](double cells) ACTIVE_INLINED
    { return std::min(std::max(cells, -Farthest), Farthest); };
    view.At[0][axis] = clamp(place.Low[axis] * level.InverseSize);
    view.At[1][axis] = clamp(place.High[axis] * level.InverseSize);
    most = std::max({ most, -view.At[0][axis], view.At[1][axis] });
  }
  const double reach = level.Reach * level.InverseSize + Slack * (most + 2.0);
  for (int axis = 0; axis < 3; ++axis)
  {
    view.First[axis] = GetCell(view.At[0][axis] - reach);
    view.Last[axis] = GetCell(view.At[1][axis] + reach);
  }
  view.Reach2 = IsLast(GetCell(most)) ? Everywhere : GetSquare(reach);
  return view;
}

ACTIVE_ALWAYS_INLINE void BallCells::LookFrom(const Coordinate block[3], View& view)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const Coordinate corner = 4 * block[axis];
    view.Low[axis] = Clamp(view.At[0][axis] - static_cast<double>(corner));
    view.High[axis] = Clamp(view.At[1][axis] - static_cast<double>(corner));
    view.Begin[axis] = static_cast<int>(std::max(view.First[axis] - corner, Coordinate(0)));
    view.End[axis] = static_cast<int>(std::min(view.Last[axis] - corner, Coordinate(3)));
  }
}

// Distance from the place to a layer of cells, in cells.
ACTIVE_ALWAYS_INLINE float BallCells::GetGap(const View& view, int axis, int cell)
{
  const auto from = static_cast<float>(cell);
  return std::max(std::max(from - view.High[axis], view.Low[axis] - (from + 1.f)), 0.f);
}

template <class Visitor>
ACTIVE_ALWAYS_INLINE void BallCells::VisitBlock(Index block, const View& view, Visitor visit) const
{
  for (int x = view.Begin[0]; x <= view.End[0]; ++x)
  {
    const float gapX = GetGap(view, 0, x);
    for (int y = view.Begin[1]; y <= view.End[1]; ++y)
    {
      const float gapY = GetGap(view, 1, y);
      if (gapX * gapX + gapY * gapY <= view.Reach2)
      {
        const Index* starts = &this->Starts[CellsPerBlock * block + 16 * x + 4 * y];
        this->VisitRow(starts[view.Begin[2]], starts[view.End[2] + 1], view, visit);
      }
    }
  }
}

// The first loop is vectorised. The second has no branch, because hits are unpredictable.
template <class Visitor>
ACTIVE_ALWAYS_INLINE void BallCells::VisitRow(
  Index begin, Index end, const View& view, Visitor visit) const
{
  const View at = view;
  const auto gap = [](float low, float high, float centre) ACTIVE_INLINED
  { return std::max(std::max(low - centre, centre - high), 0.f); };
  Index isHit[HitsAtOnce], hits[HitsAtOnce];
  for (Index first = begin; first < end; first += HitsAtOnce)
  {
    const Index looked = std::min(end - first, static_cast<Index>(HitsAtOnce));
    const float* x = this->Columns[0].data() + first;
    const float* y = this->Columns[1].data() + first;
    const float* z = this->Columns[2].data() + first;
    const float* radius2 = this->Columns[3].data() + first;
    for (Index i = 0; i < looked; ++i)
    {
      const float dx = gap(at.Low[0], at.High[0], x[i]);
      const float dy = gap(at.Low[1], at.High[1], y[i]);
      const float dz = gap(at.Low[2], at.High[2], z[i]);
      isHit[i] = dx * dx + dy * dy + dz * dz < radius2[i] ? 1 : 0;
    }
    std::size_t count = 0;
    for (Index i = 0; i < looked; ++i)
    {
      hits[count] = first + i;
      count += isHit[i];
    }
    visit(hits, count);
  }
}

}

#endif
