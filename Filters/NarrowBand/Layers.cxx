#include "Layers.h"

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace activesurface
{

namespace
{

/** Ten rows of ten rows of ten bits: the signs of a leaf and of one node around it. Bit z + 1. */
struct SignBlock
{
  unsigned Row[10][10];

  SignBlock(const LeafTable& table, const BandLeaf& leaf)
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
  void Take(int nx, int ny, const LeafMask& before, const LeafMask& middle, const LeafMask& after)
  {
    const int x0 = nx < 0 ? 7 : 0, x1 = nx > 0 ? 0 : 7;
    const int y0 = ny < 0 ? 7 : 0, y1 = ny > 0 ? 0 : 7;
    for (int x = x0; x <= x1; ++x)
    {
      for (int y = y0; y <= y1; ++y)
      {
        this->Row[8 * nx + x + 1][8 * ny + y + 1] =
          (before.Row(x, y) >> 7) | (middle.Row(x, y) << 1) | ((after.Row(x, y) & 1u) << 9);
      }
    }
  }
};

/** Crossed voxels with lower corners -1..7 around a leaf; bit z + 1. */
struct CrossedVoxels
{
  unsigned Row[9][9];

  explicit CrossedVoxels(const SignBlock& sign)
  {
    for (int x = 0; x < 9; ++x)
    {
      for (int y = 0; y < 9; ++y)
      {
        const unsigned a = sign.Row[x][y], b = sign.Row[x + 1][y];
        const unsigned c = sign.Row[x][y + 1], d = sign.Row[x + 1][y + 1];
        const unsigned any = a | b | c | d, all = a & b & c & d;
        this->Row[x][y] = (any | any >> 1) & ~(all & all >> 1) & 0x1ffu;
      }
    }
  }

  LeafMask Corners() const
  {
    LeafMask corners;
    for (int x = 0; x < 8; ++x)
    {
      for (int y = 0; y < 8; ++y)
      {
        const unsigned voxels =
          this->Row[x][y] | this->Row[x + 1][y] | this->Row[x][y + 1] | this->Row[x + 1][y + 1];
        corners.Word[x] |= std::uint64_t((voxels | voxels >> 1) & 0xffu) << (8 * y);
      }
    }
    return corners;
  }

  /** Whether a crossed voxel has a corner in the neighbour leaf at these offsets. */
  bool Touch(int dx, int dy, int dz) const
  {
    const unsigned bits = dz < 0 ? 0x001u : dz > 0 ? 0x100u : 0x1ffu;
    for (int x = dx > 0 ? 8 : 0; x <= (dx < 0 ? 0 : 8); ++x)
    {
      for (int y = dy > 0 ? 8 : 0; y <= (dy < 0 ? 0 : 8); ++y)
      {
        if (this->Row[x][y] & bits)
        {
          return true;
        }
      }
    }
    return false;
  }
};

void FindLayerZero(LeafTable& table)
{
  table.ForEach(
    [&](std::size_t i)
    {
      BandLeaf& leaf = table[i];
      const CrossedVoxels crossed{ SignBlock(table, leaf) };
      leaf.Upto[0] = crossed.Corners();
      leaf.Wanted = 0;
      for (int n = 0; n < 27; ++n)
      {
        if (leaf.Neighbour[n] < 0 && n != 13 && crossed.Touch(n / 9 - 1, n / 3 % 3 - 1, n % 3 - 1))
        {
          leaf.Wanted |= 1u << n;
        }
      }
    });
}

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
  bool added = false;
  for (std::size_t i = 0; i < table.Size(); ++i)
  {
    for (std::uint32_t wanted = table[i].Wanted; wanted != 0; wanted &= wanted - 1)
    {
      const int n = __builtin_ctz(wanted);
      tree.touchLeaf(
        table[i].Origin.offsetBy(8 * (n / 9 - 1), 8 * (n / 3 % 3 - 1), 8 * (n % 3 - 1)));
      added = true;
    }
  }
  if (added)
  {
    table.Rebuild(tree);
    ReadSigns(table);
  }
  return added;
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
      for (int axis = 0; axis < 3; ++axis)
      {
        const LeafMask& next = table.InsideOf(leaf.Neighbour[FaceNumber(axis, 1)]);
        leaf.Edge[axis] = leaf.Inside ^ SeenAhead(leaf.Inside, next, axis, 1);
      }
    });
}

void RetireNodes(LeafTable& table)
{
  table.ForEach(
    [&](std::size_t i)
    {
      BandLeaf& leaf = table[i];
      LeafMask::All()
        .Without(leaf.Upto[LastLayer])
        .ForEach(
          [&](int node) {
            leaf.Value[node] =
              table.BackgroundOf(leaf.Inside.Has(node) ? NoLeafInside : NoLeafOutside);
          });
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
    FindLayerZero(table);
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
    BandLeaf& leaf = table[i];
    leaf.FirstCrossing = count;
    for (int axis = 0; axis < 3; ++axis)
    {
      leaf.CrossingsBefore[axis] = static_cast<int>(count - leaf.FirstCrossing);
      count += leaf.Edge[axis].Count();
    }
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
