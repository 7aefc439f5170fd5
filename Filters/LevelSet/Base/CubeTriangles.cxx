#include "Base/CubeTriangles.h"

#include <algorithm>
#include <utility>
#include <vector>

// Construction of the table. On each face, a segment cuts off every run of adjacent inside corners.
// A counter-clockwise walk around the face, seen from outside the voxel, enters the run at the
// first edge of the segment, and leaves the run at the last. A crossed edge lies on two faces: it
// ends a segment of one face, and begins a segment of the other face. The segments therefore form
// closed loops, which are filled with triangles.
//
// No diagonal connects two edges of one face: the neighbour voxel across the face might use the
// same diagonal, which would then belong to four triangles. Other diagonals run through the
// interior of the voxel, where no neighbour can meet them. Every loop of all 256 cases (3 to 7
// edges) can be filled in this way without an extra vertex; TestCubeTriangles checks the triangles
// of all cases.

namespace activesurface
{
namespace
{
using Loop = std::vector<int>;
using Corners = std::array<int, 4>;

struct Filling
{
  int Cost = 0;
  std::vector<std::array<int, 3>> Triangles;
};

constexpr int None = -1;
constexpr int Forbidden = 1000;

bool IsInside(unsigned insideBits, int corner)
{
  return (insideBits >> corner & 1u) != 0;
}

// The four corners of a face, counter-clockwise seen from outside the voxel.
Corners CornersOfFace(int axis, int side)
{
  const int x = side * (4 >> axis);
  const int y = 4 >> (axis + 1) % 3;
  const int z = 4 >> (axis + 2) % 3;
  Corners corners = { x, x + y, x + y + z, x + z };
  if (side == 0)
  {
    std::reverse(corners.begin(), corners.end());
  }
  return corners;
}

int EdgeBetween(int corner, int otherCorner)
{
  int edge = 0;
  while (LowerCornerOfEdge[edge] != std::min(corner, otherCorner) ||
    UpperCornerOfEdge(edge) != std::max(corner, otherCorner))
  {
    ++edge;
  }
  return edge;
}

// Twice the coordinate of the edge's midpoint [voxels]: 0 or 2 on a face, 1 in between.
int MiddleOfEdge(int edge, int axis)
{
  return OffsetOfCorner(LowerCornerOfEdge[edge], axis) +
    OffsetOfCorner(UpperCornerOfEdge(edge), axis);
}

// Squared distance of the midpoints of two edges [(voxel / 2)^2]; at least Forbidden if both edges
// lie on one face.
int CostOfDiagonal(int edge, int otherEdge)
{
  int cost = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const int middle = MiddleOfEdge(edge, axis);
    const int step = MiddleOfEdge(otherEdge, axis) - middle;
    cost += step == 0 && middle != 1 ? Forbidden : step * step;
  }
  return cost;
}

// Cuts off each run of inside corners by its own segment.
void CutFace(const Corners& face, unsigned insideBits, std::array<int, EdgesOfVoxel>& next)
{
  for (int i = 0; i < 4; ++i)
  {
    int last = (i + 1) % 4;
    if (IsInside(insideBits, face[i]) || !IsInside(insideBits, face[last]))
    {
      continue;
    }
    const int entry = EdgeBetween(face[i], face[last]);
    while (IsInside(insideBits, face[(last + 1) % 4]))
    {
      last = (last + 1) % 4;
    }
    next[entry] = EdgeBetween(face[last], face[(last + 1) % 4]);
  }
}

std::vector<Loop> TraceLoops(unsigned insideBits)
{
  std::array<int, EdgesOfVoxel> next;
  next.fill(None);
  for (int axis = 0; axis < 3; ++axis)
  {
    CutFace(CornersOfFace(axis, 0), insideBits, next);
    CutFace(CornersOfFace(axis, 1), insideBits, next);
  }

  std::vector<Loop> loops;
  for (int start = 0; start < EdgesOfVoxel; ++start)
  {
    Loop loop;
    for (int edge = start; next[edge] != None;)
    {
      loop.push_back(edge);
      edge = std::exchange(next[edge], None);
    }
    if (!loop.empty())
    {
      loops.push_back(loop);
    }
  }
  return loops;
}

// Returns the cheapest filling of the part of a loop between `first` and `last`.
Filling FillLoop(const Loop& loop, int first, int last)
{
  Filling best;
  if (last - first < 2)
  {
    return best;
  }
  best.Cost = Forbidden * EdgesOfVoxel;
  for (int k = first + 1; k < last; ++k)
  {
    Filling one = FillLoop(loop, first, k);
    const Filling other = FillLoop(loop, k, last);
    one.Cost += other.Cost;
    one.Cost += k > first + 1 ? CostOfDiagonal(loop[first], loop[k]) : 0;
    one.Cost += k < last - 1 ? CostOfDiagonal(loop[k], loop[last]) : 0;
    if (one.Cost < best.Cost)
    {
      one.Triangles.insert(one.Triangles.end(), other.Triangles.begin(), other.Triangles.end());
      one.Triangles.push_back({ loop[first], loop[k], loop[last] });
      best = one;
    }
  }
  return best;
}

VoxelTriangles MakeTriangles(unsigned insideBits)
{
  VoxelTriangles voxel;
  for (const Loop& loop : TraceLoops(insideBits))
  {
    for (const auto& triangle : FillLoop(loop, 0, static_cast<int>(loop.size()) - 1).Triangles)
    {
      std::copy(triangle.begin(), triangle.end(), voxel.Edge[voxel.Count++]);
    }
  }
  return voxel;
}

std::array<VoxelTriangles, 256> MakeTable()
{
  std::array<VoxelTriangles, 256> table;
  for (unsigned insideBits = 0; insideBits < table.size(); ++insideBits)
  {
    table[insideBits] = MakeTriangles(insideBits);
  }
  return table;
}
}

const VoxelTriangles& TrianglesOfVoxel(unsigned insideBits)
{
  static const std::array<VoxelTriangles, 256> table = MakeTable();
  return table[insideBits & 255u];
}
}
