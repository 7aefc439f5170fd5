/**
 * The values of a leaf with those around it that stencils read, in one piece of memory: two nodes
 * along the axes, one along the diagonals of two axes. All else in the block is not set.
 */
#ifndef LeafBlock_h
#define LeafBlock_h

#include "InstructionSets.h"
#include "LeafTable.h"

#include <cstring>

namespace activesurface
{

struct LeafBlock
{
  static constexpr int Halo = 2;
  static constexpr int Side = 8 + 2 * Halo;
  static constexpr int X = Side * Side; //< distance of neighbours along x
  static constexpr int Y = Side;
  static constexpr int Z = 1;

  alignas(64) float Value[Side * Side * Side];

  ACTIVE_ALWAYS_INLINE void Gather(const LeafTable& table, const BandLeaf& leaf)
  {
    this->GatherRows<0, 0, 2>(table, leaf);
    this->GatherRows<-1, 0, 1>(table, leaf);
    this->GatherRows<1, 0, 1>(table, leaf);
    this->GatherRows<0, -1, 1>(table, leaf);
    this->GatherRows<0, 1, 1>(table, leaf);
    this->GatherRows<-1, -1, 0>(table, leaf);
    this->GatherRows<-1, 1, 0>(table, leaf);
    this->GatherRows<1, -1, 0>(table, leaf);
    this->GatherRows<1, 1, 0>(table, leaf);
  }

  /** Only what the stencils of the row (x, y) of the leaf read. */
  ACTIVE_ALWAYS_INLINE void GatherAround(const LeafTable& table, const BandLeaf& leaf, int x, int y)
  {
    constexpr int steps[][2] = { { 0, 0 }, { -2, 0 }, { -1, 0 }, { 1, 0 }, { 2, 0 }, { 0, -2 },
      { 0, -1 }, { 0, 1 }, { 0, 2 }, { -1, -1 }, { -1, 1 }, { 1, -1 }, { 1, 1 } };
    for (const auto& step : steps)
    {
      this->GatherRow(table, leaf, x + step[0], y + step[1]);
    }
  }

  /** The row (x, y) of the leaf itself. */
  const float* Row(int x, int y) const
  {
    return this->Value + (x + Halo) * X + (y + Halo) * Y + Halo;
  }

private:
  /** Where the rows of a leaf lie; where there is none, one row stands for all. */
  struct Rows
  {
    const float* First;
    int Stride;

    ACTIVE_ALWAYS_INLINE Rows(const LeafTable& table, std::int32_t number)
      : First(number >= 0 ? table[number].Value : table.BackgroundRowOf(number))
      , Stride(number >= 0 ? 8 : 0)
    {
    }

    ACTIVE_ALWAYS_INLINE const float* operator[](int row) const
    {
      return this->First + this->Stride * row;
    }
  };

  /** Any row, with two nodes before and after. */
  ACTIVE_ALWAYS_INLINE void GatherRow(const LeafTable& table, const BandLeaf& leaf, int x, int y)
  {
    const std::int32_t* number = &leaf.Neighbour[NeighbourNumber(x >> 3, y >> 3, -1)];
    const Rows before(table, number[0]), middle(table, number[1]), after(table, number[2]);
    const int row = 8 * (x & 7) + (y & 7);
    float* to = this->Value + (x + Halo) * X + (y + Halo) * Y + Halo;
    std::memcpy(to, middle[row], 8 * sizeof(float));
    std::memcpy(to - Halo, before[row] + 8 - Halo, Halo * sizeof(float));
    std::memcpy(to + 8, after[row], Halo * sizeof(float));
  }

  /** The rows that lie in the leaf's neighbour (nx, ny), with so many nodes before and after. */
  template <int nx, int ny, int Around>
  ACTIVE_ALWAYS_INLINE void GatherRows(const LeafTable& table, const BandLeaf& leaf)
  {
    constexpr int thick = nx != 0 && ny != 0 ? 1 : Halo;
    constexpr int x0 = nx < 0 ? 8 - thick : 0, x1 = nx > 0 ? thick : 8;
    constexpr int y0 = ny < 0 ? 8 - thick : 0, y1 = ny > 0 ? thick : 8;
    const std::int32_t* number = &leaf.Neighbour[NeighbourNumber(nx, ny, -1)];
    const Rows before(table, number[0]), middle(table, number[1]), after(table, number[2]);
    for (int x = x0; x < x1; ++x)
    {
      for (int y = y0; y < y1; ++y)
      {
        const int row = 8 * x + y;
        float* to = this->Value + (8 * nx + x + Halo) * X + (8 * ny + y + Halo) * Y + Halo;
        std::memcpy(to, middle[row], 8 * sizeof(float));
        std::memcpy(to - Around, before[row] + 8 - Around, Around * sizeof(float));
        std::memcpy(to + 8, after[row], Around * sizeof(float));
      }
    }
  }
};

}

#endif
