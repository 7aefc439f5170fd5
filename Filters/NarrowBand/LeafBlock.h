/**
 * The values of a leaf with those of two nodes around it, in one piece of memory.
 */
#ifndef LeafBlock_h
#define LeafBlock_h

#include "LeafTable.h"

#include <algorithm>

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

  void Gather(const LeafTable& table, const BandLeaf& leaf)
  {
    for (int nx = -1; nx <= 1; ++nx)
    {
      for (int ny = -1; ny <= 1; ++ny)
      {
        const std::int32_t* number = &leaf.Neighbour[NeighbourNumber(nx, ny, -1)];
        this->GatherColumn(
          nx, ny, Source(table, number[0]), Source(table, number[1]), Source(table, number[2]));
      }
    }
  }

  /** The row (x, y) of the leaf itself. */
  const float* Row(int x, int y) const
  {
    return this->Value + (x + Halo) * X + (y + Halo) * Y + Halo;
  }

private:
  struct RowSource
  {
    const float* Value;
    int Step; // 1, or 0 where one value stands for all nodes
  };

  static RowSource Source(const LeafTable& table, std::int32_t number)
  {
    return number >= 0 ? RowSource{ table[number].Value, 1 }
                       : RowSource{ &table.BackgroundOf(number), 0 };
  }

  void GatherColumn(int nx, int ny, RowSource before, RowSource middle, RowSource after)
  {
    const int x0 = nx < 0 ? 8 - Halo : 0, x1 = nx > 0 ? Halo : 8;
    const int y0 = ny < 0 ? 8 - Halo : 0, y1 = ny > 0 ? Halo : 8;
    for (int x = x0; x < x1; ++x)
    {
      for (int y = y0; y < y1; ++y)
      {
        const int row = 64 * x + 8 * y;
        float* to = this->Value + (8 * nx + x + Halo) * X + (8 * ny + y + Halo) * Y;
        const float* from = before.Value + before.Step * (row + 8 - Halo);
        to[0] = from[0];
        to[1] = from[before.Step];
        from = middle.Value + middle.Step * row;
        if (middle.Step)
        {
          std::copy_n(from, 8, to + Halo);
        }
        else
        {
          std::fill_n(to + Halo, 8, *from);
        }
        from = after.Value + after.Step * row;
        to[Halo + 8] = from[0];
        to[Halo + 9] = from[after.Step];
      }
    }
  }
};

}

#endif
