// Finds the elements of a skeleton whose supports may contain a point.
//
// Balls cover the supports: one ball for a point, several for a long segment. Balls of sizes within
// a factor of two are listed in the cells of one lattice, by their centres. A cell is as wide as
// the largest radius in the lattice, so the search for a point usually visits 27 cells of each
// lattice. Cells are found by a hash: memory is O(elements), independent of the extent.

#ifndef ElementIndex_h
#define ElementIndex_h

#include "Base/CompilerBuiltins.h"
#include "Base/IndexMap.h"
#include "vtkActiveParticlesModule.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
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

class VTKACTIVEPARTICLES_EXPORT ElementIndex
{
public:
  using Index = std::uint32_t;

  // A point, or a box around several points.
  struct Place
  {
    double Low[3];
    double High[3];
  };

  // Removes the elements; keeps the capacity.
  void Clear() { this->Supports.clear(); }

  void AddBall(const double centre[3], double radius);
  void Add(const Capsule& support);

  // Call after the last element is added and before the first search. Throws std::length_error if
  // the supports need more than 2^31 - 1 balls.
  void Build();

  std::size_t Size() const { return this->Supports.size(); }
  const Capsule& operator[](std::size_t i) const { return this->Supports[i]; }

  // Bounding box of all supports: xmin xmax ymin ... Undefined without elements.
  const double* GetBounds() const { return this->Bounds; }

  // Finds the cell of a point in the finest lattice. Returns false without elements, or if the
  // point is too far from the origin for cell coordinates.
  bool FindCell(const double x[3], NodeIndex& cell) const;

  // Calls visit(hits, count) once, with the indices of all elements whose supports may touch the
  // place, in ascending order. Thread-safe.
  template <class Visitor>
  ACTIVE_ALWAYS_INLINE void VisitHits(const Place& place, Visitor visit) const;

private:
  using Hits = std::vector<Index>;

  // Maximum cell coordinate; all points farther from the origin are in the outermost cells.
  static constexpr double FarthestCell = 281474976710656.0; // 2^48: rounding is below 1/16 cell

  struct Lattice
  {
    int Number;
    double CellSize;
  };

  struct Ball
  {
    double Centre[3];
    double Radius;
    Index Element;
  };

  void AddBalls(Index element, const Capsule& support);
  int LevelOf(const Ball& ball) const;
  void MakeLattices();
  void FillCells();
  static double CellOf(double x, double cellSize)
  {
    return std::min(std::max(std::floor(x / cellSize), -FarthestCell), FarthestCell);
  }
  // Hash keys: cell coordinates modulo 2^32; the first number also contains the lattice. Different
  // cells with equal keys cost only time.
  static NodeIndex KeyOf(const Lattice& lattice, const std::int64_t (&cell)[3])
  {
    constexpr std::uint32_t perLattice = 0x9e3779b1u;
    return { static_cast<int>(static_cast<std::uint32_t>(cell[0]) +
               perLattice * static_cast<std::uint32_t>(lattice.Number)),
      static_cast<int>(static_cast<std::uint32_t>(cell[1])),
      static_cast<int>(static_cast<std::uint32_t>(cell[2])) };
  }
  ACTIVE_ALWAYS_INLINE void AddHits(Index first, Index end, const Place& place, Hits& hits) const;

  std::vector<Capsule> Supports;
  double Bounds[6];
  double Slack = 0.0;            // bound on the rounding error of a coordinate
  std::vector<Lattice> Lattices; // fine to coarse
  IndexMap Cells;
  std::vector<Index> Starts; // of each cell, and the end of the last
  // Balls sorted by cell, then by element.
  std::vector<double> X, Y, Z, Radius2;
  std::vector<Index> Elements;

  // Buffers of Build; members keep their capacity.
  std::vector<Ball> Balls;
  std::vector<Index> CellOfBall;
};

// The loop has no branch, because hits are unpredictable.
ACTIVE_ALWAYS_INLINE void ElementIndex::AddHits(
  Index first, Index end, const Place& place, Hits& hits) const
{
  const auto gap = [](double low, double high, double centre) ACTIVE_INLINED
  { return std::max(std::max(low - centre, centre - high), 0.0); };
  std::size_t count = hits.size();
  hits.resize(count + (end - first));
  for (Index i = first; i < end; ++i)
  {
    const double x = gap(place.Low[0], place.High[0], this->X[i]);
    const double y = gap(place.Low[1], place.High[1], this->Y[i]);
    const double z = gap(place.Low[2], place.High[2], this->Z[i]);
    hits[count] = this->Elements[i];
    count += x * x + y * y + z * z <= this->Radius2[i] ? 1 : 0;
  }
  hits.resize(count);
}

template <class Visitor>
ACTIVE_ALWAYS_INLINE void ElementIndex::VisitHits(const Place& place, Visitor visit) const
{
  thread_local Hits hits;
  hits.clear();
  for (const Lattice& lattice : this->Lattices)
  {
    std::int64_t low[3], high[3], cell[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      const double reach = lattice.CellSize + this->Slack;
      low[axis] = static_cast<std::int64_t>(CellOf(place.Low[axis] - reach, lattice.CellSize));
      high[axis] = static_cast<std::int64_t>(CellOf(place.High[axis] + reach, lattice.CellSize));
    }
    for (cell[0] = low[0]; cell[0] <= high[0]; ++cell[0])
    {
      for (cell[1] = low[1]; cell[1] <= high[1]; ++cell[1])
      {
        for (cell[2] = low[2]; cell[2] <= high[2]; ++cell[2])
        {
          const std::int32_t found = this->Cells.Find(KeyOf(lattice, cell));
          if (found >= 0)
          {
            this->AddHits(this->Starts[found], this->Starts[found + 1], place, hits);
          }
        }
      }
    }
  }
  std::sort(hits.begin(), hits.end());
  visit(
    hits.data(), static_cast<std::size_t>(std::unique(hits.begin(), hits.end()) - hits.begin()));
}

}

#endif
