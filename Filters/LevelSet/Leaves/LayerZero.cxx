#include "Leaves/LayerZero.h"

#include "Leaves/LeafKernels.h"

#include <array>
#include <cstdint>
#include <cstring>

namespace activesurface
{

namespace
{

constexpr int RowsWritten = 16; // 9 are used; 16 fill a vector
constexpr int RowsRead = RowsWritten + 8;

using RowBytes = std::array<std::uint8_t, 8>;

static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "the first row is the lowest byte");

/** The eight rows of a word. */
ACTIVE_ALWAYS_INLINE RowBytes BytesOf(std::uint64_t word)
{
  RowBytes bytes;
  std::memcpy(bytes.data(), &word, sizeof word);
  return bytes;
}

ACTIVE_ALWAYS_INLINE std::uint64_t WordOf(const RowBytes& bytes)
{
  std::uint64_t word;
  std::memcpy(&word, bytes.data(), sizeof word);
  return word;
}

/** The signs of a leaf and of the layer of nodes around the leaf: node (x, y, z) is bit z + 1 of
 * Row[x + 1][y + 1]. Inner loops run over y, so that the compiler vectorises them. */
struct SignBlock
{
  std::uint16_t Row[10][RowsRead] = {};

  ACTIVE_ALWAYS_INLINE SignBlock(const LeafTable& table, const BandLeaf& leaf)
  {
    for (int nx = -1; nx <= 1; ++nx)
    {
      for (int ny = -1; ny <= 1; ++ny)
      {
        const LeafMask& before = table.InsideOf(leaf.Neighbour[NeighbourNumber(nx, ny, -1)]);
        const LeafMask& middle = nx == 0 && ny == 0
          ? leaf.Inside
          : table.InsideOf(leaf.Neighbour[NeighbourNumber(nx, ny, 0)]);
        const LeafMask& after = table.InsideOf(leaf.Neighbour[NeighbourNumber(nx, ny, 1)]);
        this->SetRows(nx, ny, before, middle, after);
      }
    }
  }

private:
  ACTIVE_ALWAYS_INLINE void SetRows(
    int nx, int ny, const LeafMask& before, const LeafMask& middle, const LeafMask& after)
  {
    const int x0 = nx < 0 ? 7 : 0, x1 = nx > 0 ? 0 : 7;
    for (int x = x0; x <= x1; ++x)
    {
      std::uint16_t* row = this->Row[8 * nx + x + 1];
      if (ny != 0)
      {
        const int y = ny < 0 ? 7 : 0;
        row[ny < 0 ? 0 : 9] = static_cast<std::uint16_t>(
          (before.Row(x, y) >> 7) | (middle.Row(x, y) << 1) | ((after.Row(x, y) & 1u) << 9));
        continue;
      }
      const RowBytes b = BytesOf(before.Word[x]), m = BytesOf(middle.Word[x]);
      const RowBytes a = BytesOf(after.Word[x]);
      for (int y = 0; y < 8; ++y)
      {
        row[y + 1] = static_cast<std::uint16_t>(b[y] >> 7 | m[y] << 1 | (a[y] & 1) << 9);
      }
    }
  }
};

/** Crossed voxels whose lower corners have coordinates -1 to 7 relative to a leaf: bit z + 1 of the
 * row [x + 1][y + 1]. */
struct CrossedVoxels
{
  std::uint16_t Row[9][RowsRead];

  ACTIVE_ALWAYS_INLINE explicit CrossedVoxels(const SignBlock& sign)
  {
    for (int x = 0; x < 9; ++x)
    {
      const std::uint16_t *p = sign.Row[x], *q = sign.Row[x + 1];
      for (int y = 0; y < RowsWritten; ++y)
      {
        this->Row[x][y] =
          static_cast<std::uint16_t>(CrossedInRow(p[y], q[y], p[y + 1], q[y + 1]) & 0x1ffu);
      }
    }
  }

  ACTIVE_ALWAYS_INLINE LeafMask Corners() const
  {
    LeafMask corners;
    for (int x = 0; x < 8; ++x)
    {
      const std::uint16_t *p = this->Row[x], *q = this->Row[x + 1];
      RowBytes bytes;
      for (int y = 0; y < 8; ++y)
      {
        const unsigned voxels = p[y] | q[y] | p[y + 1] | q[y + 1];
        bytes[y] = static_cast<std::uint8_t>(voxels | voxels >> 1);
      }
      corners.Word[x] = WordOf(bytes);
    }
    return corners;
  }

  /** Unions of the rows of crossed voxels over the first, all, or the last indices along x and y.
   */
  struct Shadows
  {
    unsigned Of[3][3] = {}; //< by x and y; 0: first, 1: all, 2: last
  };

  ACTIVE_ALWAYS_INLINE Shadows FindShadows() const
  {
    std::uint16_t all[RowsRead] = {};
    for (int x = 0; x < 9; ++x)
    {
      for (int y = 0; y < RowsWritten; ++y)
      {
        all[y] = static_cast<std::uint16_t>(all[y] | this->Row[x][y]);
      }
    }
    const std::uint16_t* of[3] = { this->Row[0], all, this->Row[8] };
    Shadows shadows;
    for (int x = 0; x < 3; ++x)
    {
      shadows.Of[x][0] = of[x][0];
      shadows.Of[x][2] = of[x][8];
      for (int y = 0; y < 9; ++y)
      {
        shadows.Of[x][1] |= of[x][y];
      }
    }
    return shadows;
  }
};

/** Returns the bits of the neighbours in which a crossed voxel has a corner. */
std::uint32_t NeighboursTouched(const CrossedVoxels::Shadows& shadows)
{
  constexpr unsigned bits[3] = { 0x001u, 0x1ffu, 0x100u };
  std::uint32_t touched = 0;
  for (int n = 0; n < 27; ++n)
  {
    touched |= std::uint32_t((shadows.Of[n / 9][n / 3 % 3] & bits[n % 3]) != 0) << n;
  }
  return touched;
}

/** Returns the bits of the neighbours without a leaf. */
std::uint32_t NeighboursWithoutLeaf(const BandLeaf& leaf)
{
  std::uint32_t missing = 0;
  for (int n = 0; n < 27; ++n)
  {
    missing |= std::uint32_t(leaf.Neighbour[n] < 0) << n;
  }
  return missing & ~(1u << 13);
}

struct FindInLeaf
{
  LeafTable& Table;

  ACTIVE_ALWAYS_INLINE void operator()(std::size_t i) const
  {
    BandLeaf& leaf = this->Table[i];
    const CrossedVoxels crossed{ SignBlock(this->Table, leaf) };
    leaf.UpToLayer[0] = crossed.Corners();
    leaf.MissingNeighbours = 0;
    if (const std::uint32_t missing = NeighboursWithoutLeaf(leaf))
    {
      leaf.MissingNeighbours = missing & NeighboursTouched(crossed.FindShadows());
    }
  }
};

}

void FindLayerZero(LeafTable& table, const LeafList& leaves)
{
  ForEachLeaf(table, leaves, FindInLeaf{ table });
}

}
