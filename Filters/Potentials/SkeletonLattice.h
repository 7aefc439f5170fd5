// Unbounded lattice of cubic cells, hashed into slots. A block of 4x4x4 cells has a slot for each
// cell; the hash determines the position of the block. Collisions of slots cost time, not
// correctness.

#ifndef SkeletonLattice_h
#define SkeletonLattice_h

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace activesurface
{

struct SkeletonLattice
{
  using Index = std::uint32_t;

  static constexpr int BlockBits = 6;
  static constexpr Index LastCell = 0x7fffffff;

  double Origin[3];
  double CellSize;
  double InverseCellSize;
  std::size_t Elements;
  std::size_t FirstSlot;
  int HashShift;

  // Returns a coordinate in cells.
  double GetCoordinate(double x, int axis) const
  {
    return (x - this->Origin[axis]) * this->InverseCellSize;
  }

  // Returns a cell; the first and the last cell contain all points beyond. The cell is monotonic in
  // x, also in floating point. The cells of two points therefore enclose those of all points
  // between.
  static Index GetCell(double coordinate)
  {
    return static_cast<Index>(std::min(std::max(coordinate, 0.0), static_cast<double>(LastCell)));
  }

  // Hash along one axis. A slot combines the sum of three hashes and the union of three bit
  // patterns.
  static std::uint64_t GetHash(Index cell, int axis)
  {
    constexpr std::uint64_t factors[3] = { 0x9e3779b97f4a7c15u, 0xc2b2ae3d27d4eb4fu,
      0x165667b19e3779f9u };
    return (cell >> 2) * factors[axis];
  }

  static Index GetPlaceInBlock(Index cell, int axis) { return (cell & 3) << (2 * axis); }

  std::size_t GetSlot(std::uint64_t hash, Index placeInBlock) const
  {
    const auto block = static_cast<std::size_t>(hash >> this->HashShift);
    return this->FirstSlot + (block << BlockBits | placeInBlock);
  }

  std::size_t GetSlot(const Index cell[3]) const
  {
    return this->GetSlot(GetHash(cell[0], 0) + GetHash(cell[1], 1) + GetHash(cell[2], 2),
      GetPlaceInBlock(cell[0], 0) | GetPlaceInBlock(cell[1], 1) | GetPlaceInBlock(cell[2], 2));
  }
};

}

#endif
