/**
 * The values of a leaf and of the halo that stencils read, in contiguous memory. The halo is two
 * nodes wide along the axes, and one node wide along the diagonals of two axes. Other values of the
 * block are arbitrary.
 */
#ifndef LeafBlock_h
#define LeafBlock_h

#include "Base/InstructionSets.h"
#include "Leaves/LeafTable.h"

#include <cstring>

namespace activesurface
{

/** The 512 values of a leaf. */
struct PotentialOf
{
  const LeafTable& Table;
  ACTIVE_ALWAYS_INLINE const float* operator()(std::int32_t leaf) const
  {
    return this->Table[leaf].Value;
  }
};

struct LeafBlock
{
  static constexpr int Halo = 2;
  static constexpr int Side = 8 + 2 * Halo;
  static constexpr int X = Side * Side; //< distance in memory of neighbours along x
  static constexpr int Y = Side;
  static constexpr int Z = 1;

  alignas(64) float Value[Side * Side * Side];

  /** Gathers the potential. */
  ACTIVE_ALWAYS_INLINE void Gather(const LeafTable& table, const BandLeaf& leaf)
  {
    this->Gather(table, leaf, PotentialOf{ table });
  }

  /** Gathers another field; arrayOf(leaf): the 512 numbers of a leaf. */
  template <class ArrayOf>
  ACTIVE_ALWAYS_INLINE void Gather(
    const LeafTable& table, const BandLeaf& leaf, const ArrayOf& arrayOf)
  {
    this->GatherRows<0, 0, 2>(table, leaf, arrayOf);
    this->GatherRows<-1, 0, 1>(table, leaf, arrayOf);
    this->GatherRows<1, 0, 1>(table, leaf, arrayOf);
    this->GatherRows<0, -1, 1>(table, leaf, arrayOf);
    this->GatherRows<0, 1, 1>(table, leaf, arrayOf);
    this->GatherRows<-1, -1, 0>(table, leaf, arrayOf);
    this->GatherRows<-1, 1, 0>(table, leaf, arrayOf);
    this->GatherRows<1, -1, 0>(table, leaf, arrayOf);
    this->GatherRows<1, 1, 0>(table, leaf, arrayOf);
  }

  /** Gathers the values that the stencils of row (x, y) of the leaf read. */
  ACTIVE_ALWAYS_INLINE void GatherAround(const LeafTable& table, const BandLeaf& leaf, int x, int y)
  {
    constexpr int steps[][2] = { { 0, 0 }, { -2, 0 }, { -1, 0 }, { 1, 0 }, { 2, 0 }, { 0, -2 },
      { 0, -1 }, { 0, 1 }, { 0, 2 }, { -1, -1 }, { -1, 1 }, { 1, -1 }, { 1, 1 } };
    for (const auto& step : steps)
    {
      const int atX = x + step[0], atY = y + step[1];
      RowSource(table, leaf, PotentialOf{ table }, atX >> 3, atY >> 3)
        .Copy<Halo>(8 * (atX & 7) + (atY & 7), this->Value + PlaceOf(atX, atY));
    }
  }

  /** Row (x, y) of the leaf itself. */
  const float* Row(int x, int y) const { return this->Value + PlaceOf(x, y); }

private:
  /** Offset of a row in the block; x and y are relative to the leaf. */
  static constexpr int PlaceOf(int x, int y) { return (x + Halo) * X + (y + Halo) * Y + Halo; }

  /** The rows of a leaf; a missing leaf has the background row for all rows. */
  struct Rows
  {
    const float* First;
    int Stride;

    template <class ArrayOf>
    ACTIVE_ALWAYS_INLINE Rows(const LeafTable& table, std::int32_t number, const ArrayOf& arrayOf)
      : First(number >= 0 ? arrayOf(number) : table.BackgroundRowOf(number))
      , Stride(number >= 0 ? 8 : 0)
    {
    }

    ACTIVE_ALWAYS_INLINE const float* operator[](int row) const
    {
      return this->First + this->Stride * row;
    }
  };

  /** The leaf's neighbour (nx, ny), and the leaves before and after this neighbour along z. */
  struct RowSource
  {
    Rows Before, Middle, After;

    template <class ArrayOf>
    ACTIVE_ALWAYS_INLINE RowSource(
      const LeafTable& table, const BandLeaf& leaf, const ArrayOf& arrayOf, int nx, int ny)
      : Before(table, leaf.Neighbour[NeighbourNumber(nx, ny, -1)], arrayOf)
      , Middle(table, leaf.Neighbour[NeighbourNumber(nx, ny, 0)], arrayOf)
      , After(table, leaf.Neighbour[NeighbourNumber(nx, ny, 1)], arrayOf)
    {
    }

    template <int Around>
    ACTIVE_ALWAYS_INLINE void Copy(int row, float* to) const
    {
      std::memcpy(to, this->Middle[row], 8 * sizeof(float));
      std::memcpy(to - Around, this->Before[row] + 8 - Around, Around * sizeof(float));
      std::memcpy(to + 8, this->After[row], Around * sizeof(float));
    }
  };

  /** Copies the rows in the leaf's neighbour (nx, ny), with `Around` nodes before and after. */
  template <int nx, int ny, int Around, class ArrayOf>
  ACTIVE_ALWAYS_INLINE void GatherRows(
    const LeafTable& table, const BandLeaf& leaf, const ArrayOf& arrayOf)
  {
    constexpr int thick = nx != 0 && ny != 0 ? 1 : Halo;
    constexpr int x0 = nx < 0 ? 8 - thick : 0, x1 = nx > 0 ? thick : 8;
    constexpr int y0 = ny < 0 ? 8 - thick : 0, y1 = ny > 0 ? thick : 8;
    const RowSource source(table, leaf, arrayOf, nx, ny);
    for (int x = x0; x < x1; ++x)
    {
      for (int y = y0; y < y1; ++y)
      {
        source.Copy<Around>(8 * x + y, this->Value + PlaceOf(8 * nx + x, 8 * ny + y));
      }
    }
  }
};

}

#endif
