#include "Layers.h"

#include "LeafKernels.h"

#include <cstring>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace activesurface
{

namespace
{

constexpr int RowsWritten = 16; // of which 9 mean something: as many as fill a vector
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

/** The signs of a leaf and of one node around it: rows of ten bits, bit z + 1, at [x + 1][y + 1].
 * All loops run over y, which the compiler turns into vector code. */
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
        this->Take(nx, ny, before, middle, after);
      }
    }
  }

private:
  ACTIVE_ALWAYS_INLINE void Take(
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

/** Crossed voxels with lower corners -1..7 around a leaf; bit z + 1. */
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
        const unsigned any = p[y] | q[y] | p[y + 1] | q[y + 1];
        const unsigned all = p[y] & q[y] & p[y + 1] & q[y + 1];
        this->Row[x][y] = static_cast<std::uint16_t>((any | any >> 1) & ~(all & all >> 1) & 0x1ffu);
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

  /** The crossed voxels of all rows, of the first and of the last ones, in x and in y. */
  struct Shadows
  {
    unsigned Of[3][3] = {}; //< first, all, last
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

/** Bits of the neighbours in which a crossed voxel has a corner. */
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

/** Bits of the neighbours that are no leaves. */
std::uint32_t NeighboursMissing(const BandLeaf& leaf)
{
  std::uint32_t missing = 0;
  for (int n = 0; n < 27; ++n)
  {
    missing |= std::uint32_t(leaf.Neighbour[n] < 0) << n;
  }
  return missing & ~(1u << 13);
}

struct FindLayerZero
{
  LeafTable& Table;

  ACTIVE_ALWAYS_INLINE void operator()(std::size_t i) const
  {
    BandLeaf& leaf = this->Table[i];
    const CrossedVoxels crossed{ SignBlock(this->Table, leaf) };
    leaf.Upto[0] = crossed.Corners();
    leaf.Wanted = 0;
    if (const std::uint32_t missing = NeighboursMissing(leaf))
    {
      leaf.Wanted = missing & NeighboursTouched(crossed.FindShadows());
    }
  }
};

/** Bits on the face of a mask that looks in the direction of an axis and a sign. */
bool TouchesFace(const LeafMask& mask, int axis, int sign)
{
  if (axis == 0)
  {
    return mask.Word[sign < 0 ? 0 : 7] != 0;
  }
  const std::uint64_t face = axis == 1 ? (sign < 0 ? 0xffull : 0xffull << 56)
                                       : (sign < 0 ? 1ull : 0x80ull) * 0x0101010101010101ull;
  std::uint64_t any = 0;
  for (std::uint64_t word : mask.Word)
  {
    any |= word & face;
  }
  return any != 0;
}

/** Layers 0..m: layers 0..m-1 and their 6-neighbours. */
void AddLayer(LeafTable& table, int layer)
{
  table.ForEach(
    [&](std::size_t i)
    {
      BandLeaf& leaf = table[i];
      const LeafMask& inner = leaf.Upto[layer - 1];
      LeafMask grown = inner;
      for (int axis = 0; axis < 3; ++axis)
      {
        for (int sign = -1; sign <= 1; sign += 2)
        {
          const int face = FaceNumber(axis, sign);
          const LeafMask& next = table.UptoOf(leaf.Neighbour[face], layer - 1);
          grown =
            grown | (sign > 0 ? SeenAhead(inner, next, axis, 1) : SeenBehind(inner, next, axis, 1));
          if (leaf.Neighbour[face] < 0 && TouchesFace(inner, axis, sign))
          {
            leaf.Wanted |= 1u << face;
          }
        }
      }
      leaf.Upto[layer] = grown;
    });
}

/** Creates the wanted leaves; false when there were none. */
bool AddWantedLeaves(LeafTable& table, PotentialTree& tree)
{
  if (table.Count([](const BandLeaf& leaf) { return leaf.Wanted != 0; }) == 0)
  {
    return false;
  }
  for (std::size_t i = 0; i < table.Size(); ++i)
  {
    for (std::uint32_t wanted = table[i].Wanted; wanted != 0; wanted &= wanted - 1)
    {
      const int n = __builtin_ctz(wanted);
      tree.touchLeaf(
        table[i].Origin.offsetBy(8 * (n / 9 - 1), 8 * (n / 3 % 3 - 1), 8 * (n % 3 - 1)));
    }
  }
  table.Rebuild(tree);
  ReadSigns(table);
  return true;
}

/** Nodes whose neighbours one and two steps away on the axes are all in the layers. */
LeafMask HaveAxisStencil(const LeafTable& table, const BandLeaf& leaf)
{
  const LeafMask& all = leaf.Upto[LastLayer];
  LeafMask complete = all;
  for (int axis = 0; axis < 3; ++axis)
  {
    const LeafMask& next = table.UptoOf(leaf.Neighbour[FaceNumber(axis, 1)], LastLayer);
    const LeafMask& previous = table.UptoOf(leaf.Neighbour[FaceNumber(axis, -1)], LastLayer);
    complete = complete & SeenAhead(all, next, axis, 1) & SeenAhead(all, next, axis, 2) &
      SeenBehind(all, previous, axis, 1) & SeenBehind(all, previous, axis, 2);
  }
  return complete;
}

bool HasDiagonalStencil(const LeafTable& table, std::int32_t i, int node)
{
  for (int n = 0; n < 27; ++n)
  {
    const int dx = n / 9 - 1, dy = n / 3 % 3 - 1, dz = n % 3 - 1;
    if (dx * dx + dy * dy + dz * dz != 2)
    {
      continue;
    }
    const LeafTable::Place place = table.Offset(i, node, dx, dy, dz);
    if (place.Leaf < 0 || !table[place.Leaf].Upto[LastLayer].Has(place.Node))
    {
      return false;
    }
  }
  return true;
}

void FindActiveNodes(LeafTable& table)
{
  table.ForEach(
    [&](std::size_t i)
    {
      BandLeaf& leaf = table[i];
      leaf.Active = leaf.Upto[LastBandLayer];
      const LeafMask candidates = HaveAxisStencil(table, leaf).Without(leaf.Upto[LastBandLayer]);
      candidates.ForEach(
        [&](int node)
        {
          if (HasDiagonalStencil(table, static_cast<std::int32_t>(i), node))
          {
            leaf.Active.Add(node);
          }
        });
    });
}

void FindCrossedEdges(LeafTable& table)
{
  table.ForEach(
    [&](std::size_t i)
    {
      BandLeaf& leaf = table[i];
      leaf.Crossings = 0;
      for (int axis = 0; axis < 3; ++axis)
      {
        const LeafMask& next = table.InsideOf(leaf.Neighbour[FaceNumber(axis, 1)]);
        leaf.Edge[axis] = leaf.Inside ^ SeenAhead(leaf.Inside, next, axis, 1);
        leaf.CrossingsBefore[axis] = leaf.Crossings;
        leaf.Crossings += leaf.Edge[axis].Count();
      }
    });
}

/** Nodes that have left the layers take the background; the others outside have it already. */
void RetireNodes(LeafTable& table)
{
  table.ForEach(
    [&](std::size_t i)
    {
      BandLeaf& leaf = table[i];
      leaf.Unretired.Without(leaf.Upto[LastLayer])
        .ForEach(
          [&](int node) {
            leaf.Value[node] =
              table.BackgroundOf(leaf.Inside.Has(node) ? NoLeafInside : NoLeafOutside);
          });
      leaf.Unretired = leaf.Upto[LastLayer];
    });
}

/** Which of eight numbers are negative, one bit each. */
unsigned NegativeBits(const float* values)
{
#ifdef __SSE2__
  const __m128 zero = _mm_setzero_ps();
  const int low = _mm_movemask_ps(_mm_cmplt_ps(_mm_loadu_ps(values), zero));
  const int high = _mm_movemask_ps(_mm_cmplt_ps(_mm_loadu_ps(values + 4), zero));
  return static_cast<unsigned>(low | high << 4);
#else
  unsigned bits = 0;
  for (int z = 0; z < 8; ++z)
  {
    bits |= unsigned(values[z] < 0.f) << z;
  }
  return bits;
#endif
}

}

LeafMask InsideNodes(const float* values)
{
  LeafMask inside;
  for (int row = 0; row < 64; ++row)
  {
    inside.Word[row / 8] |= std::uint64_t(NegativeBits(values + 8 * row)) << (8 * (row % 8));
  }
  return inside;
}

void ReadSigns(LeafTable& table)
{
  table.ForEach([&](std::size_t i) { table[i].Inside = InsideNodes(table[i].Value); });
}

void FindLayers(LeafTable& table, PotentialTree& tree)
{
  do
  {
    ForEachLeaf(table, FindLayerZero{ table });
    for (int layer = 1; layer < NumberOfLayers; ++layer)
    {
      AddLayer(table, layer);
    }
  } while (AddWantedLeaves(table, tree));
  FindCrossedEdges(table);
}

void RebuildLayers(LeafTable& table, PotentialTree& tree)
{
  FindLayers(table, tree);
  FindActiveNodes(table);
  RetireNodes(table);
}

void DropEmptyLeaves(LeafTable& table, PotentialTree& tree)
{
  bool dropped = false;
  for (std::size_t i = 0; i < table.Size(); ++i)
  {
    if (!IsUsed(table[i]))
    {
      const float side = table.BackgroundOf(table[i].Inside.Has(0) ? NoLeafInside : NoLeafOutside);
      tree.addTile(1, table[i].Origin, side, false);
      dropped = true;
    }
  }
  if (dropped)
  {
    table.Rebuild(tree);
  }
}

std::size_t NumberCrossings(LeafTable& table)
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < table.Size(); ++i)
  {
    table[i].FirstCrossing = count;
    count += table[i].Crossings;
  }
  return count;
}

void ReadActiveMasks(LeafTable& table)
{
  table.ForEach(
    [&](std::size_t i)
    {
      const PotentialLeaf::NodeMaskType& mask = table[i].Leaf->getValueMask();
      for (int x = 0; x < 8; ++x)
      {
        table[i].Active.Word[x] = mask.getWord<std::uint64_t>(x);
      }
    });
}

void WriteActiveMasks(const LeafTable& table)
{
  table.ForEach(
    [&](std::size_t i)
    {
      const BandLeaf& leaf = table[i];
      PotentialLeaf::NodeMaskType mask;
      for (int x = 0; x < 8; ++x)
      {
        mask.getWord<std::uint64_t>(x) = leaf.Active.Word[x];
      }
      leaf.Leaf->setValueMask(mask);
    });
}

}
