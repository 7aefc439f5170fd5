// Cubic cells without end, hashed into slots: a slot for each cell of a block of 4x4x4, the blocks
// wherever the hash puts them. Cells that share a slot cost time, not correctness.

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

  // In cells.
  double GetCoordinate(double x, int axis) const
  {
    return (x - this->Origin[axis]) * this->InverseCellSize;
  }

  // The first and the last cell hold all that lies beyond. Rises with the coordinate, which rises
  // with x, also in floating point: what lies between two points is in the cells between.
  static Index GetCell(double coordinate)
  {
    return static_cast<Index>(std::min(std::max(coordinate, 0.0), static_cast<double>(LastCell)));
  }

  // Of a cell: the sum of three hashes, the union of three bit patterns.
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
