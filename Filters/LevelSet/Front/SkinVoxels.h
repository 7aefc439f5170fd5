/**
 * Visits the voxels that the surface crosses, leaf by leaf, and their crossed edges.
 *
 * A leaf has the voxels whose lower corner is in the leaf. The corners of these voxels are the
 * nodes 0..8 along each axis; nodes 8 belong to the next leaves.
 */
#ifndef SkinVoxels_h
#define SkinVoxels_h

#include "Base/CubeTriangles.h"
#include "Leaves/LayerZero.h"
#include "Leaves/LeafTable.h"

#include <cstring>

namespace activesurface
{

constexpr int CornersAlongLeaf = 9;
constexpr int CornersOfLeaf = CornersAlongLeaf * CornersAlongLeaf * CornersAlongLeaf;

constexpr int CornerPlace(int x, int y, int z)
{
  return (CornersAlongLeaf * x + y) * CornersAlongLeaf + z;
}

inline int CornerPlace(int node)
{
  return CornerPlace(node >> 6, (node >> 3) & 7, node & 7);
}

/** Index of an edge in arrays, by its axis and its lower corner. */
constexpr int EdgePlace(int axis, int corner)
{
  return axis * CornersOfLeaf + corner;
}

/** EdgePlace of each edge of a voxel, minus the CornerPlace of the voxel. */
constexpr std::array<int, EdgesOfVoxel> MakePlacesOfEdges()
{
  std::array<int, EdgesOfVoxel> places{};
  for (int edge = 0; edge < EdgesOfVoxel; ++edge)
  {
    const int corner = LowerCornerOfEdge[edge];
    places[edge] =
      EdgePlace(AxisOfEdge(edge), CornerPlace(corner >> 2, corner >> 1 & 1, corner & 1));
  }
  return places;
}

constexpr std::array<int, EdgesOfVoxel> PlaceOfEdge = MakePlacesOfEdges();

/** Flags the inside corners of a leaf's voxels. */
class VoxelSigns
{
public:
  ACTIVE_ALWAYS_INLINE VoxelSigns(const LeafTable& table, const BandLeaf& leaf)
  {
    for (int n = 0; n < 4; ++n)
    {
      const int nx = n >> 1, ny = n & 1;
      const LeafMask& own = table.InsideOf(leaf.Neighbour[NeighbourNumber(nx, ny, 0)]);
      const LeafMask& next = table.InsideOf(leaf.Neighbour[NeighbourNumber(nx, ny, 1)]);
      this->SetRows(nx, ny, n == 0 ? leaf.Inside : own, next);
    }
  }

  /** Returns the inside corners of the voxel with this lower corner; bit c: corner c = 4 x + 2 y +
   * z. */
  ACTIVE_ALWAYS_INLINE unsigned Corners(int node) const
  {
    const int x = node >> 6, y = (node >> 3) & 7, z = node & 7;
    const auto pair = [z](unsigned row) ACTIVE_INLINED { return (row >> z) & 3u; };
    return pair(this->Row[x][y]) | pair(this->Row[x][y + 1]) << 2 | pair(this->Row[x + 1][y]) << 4 |
      pair(this->Row[x + 1][y + 1]) << 6;
  }

  /** Returns the lower corners of the crossed voxels: voxels whose corners differ in sign. */
  ACTIVE_ALWAYS_INLINE LeafMask Crossed() const
  {
    LeafMask crossed;
    for (int x = 0; x < 8; ++x)
    {
      const std::uint16_t *p = this->Row[x], *q = this->Row[x + 1];
      std::uint8_t bytes[8];
      for (int y = 0; y < 8; ++y)
      {
        bytes[y] = static_cast<std::uint8_t>(CrossedInRow(p[y], q[y], p[y + 1], q[y + 1]));
      }
      std::memcpy(&crossed.Word[x], bytes, sizeof bytes);
    }
    return crossed;
  }

private:
  ACTIVE_ALWAYS_INLINE void SetRows(int nx, int ny, const LeafMask& own, const LeafMask& next)
  {
    for (int x = 0; x < (nx ? 1 : 8); ++x)
    {
      std::uint16_t* row = this->Row[8 * nx + x] + 8 * ny;
      std::uint8_t o[8], n[8];
      std::memcpy(o, &own.Word[x], sizeof o);
      std::memcpy(n, &next.Word[x], sizeof n);
      for (int y = 0; y < (ny ? 1 : 8); ++y)
      {
        row[y] = static_cast<std::uint16_t>(o[y] | (n[y] & 1) << 8);
      }
    }
  }

  std::uint16_t Row[CornersAlongLeaf][CornersAlongLeaf]; //< bit z
};

/**
 * Calls function(node, bits) for the crossed voxels of a leaf. node: lower corner; bits: result of
 * Corners.
 */
template <class Function>
ACTIVE_ALWAYS_INLINE void ForEachCrossedVoxel(
  const LeafTable& table, std::size_t i, Function&& function)
{
  const BandLeaf& leaf = table[i];
  if (!leaf.UpToLayer[0].Any())
  {
    return;
  }
  const VoxelSigns signs(table, leaf);
  signs.Crossed().ForEach([&](int node) ACTIVE_INLINED { function(node, signs.Corners(node)); });
}

struct CrossedEdge
{
  int Axis;
  int Place;           //< EdgePlace
  std::int32_t Leaf;   //< of the lower node
  int Node;            //< the lower node
  std::int64_t Number; //< index of the crossing
};

/** Calls function(CrossedEdge) for the crossed edges along `axis` that begin in the leaf `owner`
 * and belong to the voxels of a leaf. next: offset of `owner` from the leaf of the voxels, 0 or 1
 * leaf along each axis. */
template <class Function>
ACTIVE_ALWAYS_INLINE void ForEachEdgeOfOwner(
  const LeafTable& table, std::int32_t owner, int axis, const int next[3], Function&& function)
{
  const BandLeaf& leaf = table[owner];
  const std::uint64_t rows = next[1] ? 0xffull : ~0ull;
  const std::uint64_t region = rows & (next[2] ? 0x0101010101010101ull : ~0ull);
  const int first = CornerPlace(8 * next[0], 8 * next[1], 8 * next[2]);
  std::int64_t before = static_cast<std::int64_t>(leaf.FirstCrossing) + leaf.CrossingsBefore[axis];
  for (int x = 0; x < (next[0] ? 1 : 8); ++x)
  {
    const std::uint64_t word = leaf.Edge[axis].Word[x];
    std::int64_t number = before;
    for (std::uint64_t left = word & region; left != 0; left &= left - 1)
    {
      const int bit = LowestBit(left);
      const int place = first + CornerPlace(x, bit >> 3, bit & 7);
      if (region != ~0ull)
      {
        number = before + CountBits(word & ((std::uint64_t(1) << bit) - 1));
      }
      function(CrossedEdge{ axis, EdgePlace(axis, place), owner, 64 * x + bit, number });
      ++number;
    }
    before += CountBits(word);
  }
}

/** Calls function(CrossedEdge) for all crossed edges of a leaf's voxels. */
template <class Function>
ACTIVE_ALWAYS_INLINE void ForEachCrossedEdge(
  const LeafTable& table, std::size_t i, Function&& function)
{
  for (int n = 0; n < 8; ++n)
  {
    const int next[3] = { n >> 2, n >> 1 & 1, n & 1 };
    const std::int32_t owner = n == 0
      ? static_cast<std::int32_t>(i)
      : table[i].Neighbour[NeighbourNumber(next[0], next[1], next[2])];
    for (int axis = 0; axis < 3 && owner >= 0; ++axis)
    {
      if (next[axis] == 0) // otherwise the edge is beyond the last corner
      {
        ForEachEdgeOfOwner(table, owner, axis, next, function);
      }
    }
  }
}

}

#endif
