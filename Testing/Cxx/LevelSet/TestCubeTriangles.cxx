// Triangulation of a voxel by signs: all 256 cases, all pairs of neighbours, random lattices. Tests
// only count and compare signs, so no tolerance is needed.

#include "Base/CubeTriangles.h"

#include <gtest/gtest.h>

#include <array>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

using namespace activesurface;

namespace TestCubeTriangles
{
using Point = std::array<double, 3>;
using Triangle = std::array<int, 3>;
using HalfEdges = std::map<std::pair<int, int>, int>;

// Signs at the corners of a box of voxels, and the resulting mesh. The name of a mesh vertex is its
// lattice edge: 3 * (number of the edge's lower corner) + axis.
struct Lattice
{
  std::array<int, 3> Size;
  std::vector<bool> Inside;
  std::vector<Triangle> Triangles;

  explicit Lattice(const std::array<int, 3>& size)
    : Size(size)
    , Inside(size[0] * size[1] * size[2], false)
  {
  }

  int CornerAt(const std::array<int, 3>& voxel, int corner) const
  {
    const int x = voxel[0] + OffsetOfCorner(corner, 0);
    const int y = voxel[1] + OffsetOfCorner(corner, 1);
    const int z = voxel[2] + OffsetOfCorner(corner, 2);
    return (x * this->Size[1] + y) * this->Size[2] + z;
  }

  void AddVoxel(const std::array<int, 3>& voxel)
  {
    unsigned insideBits = 0;
    for (int corner = 0; corner < CornersOfVoxel; ++corner)
    {
      insideBits |= (this->Inside[this->CornerAt(voxel, corner)] ? 1u : 0u) << corner;
    }
    const VoxelTriangles& triangles = TrianglesOfVoxel(insideBits);
    for (int t = 0; t < triangles.Count; ++t)
    {
      Triangle triangle;
      for (int i = 0; i < 3; ++i)
      {
        const int edge = triangles.Edge[t][i];
        triangle[i] = 3 * this->CornerAt(voxel, LowerCornerOfEdge[edge]) + AxisOfEdge(edge);
      }
      this->Triangles.push_back(triangle);
    }
  }

  void Polygonise()
  {
    for (int x = 0; x + 1 < this->Size[0]; ++x)
    {
      for (int y = 0; y + 1 < this->Size[1]; ++y)
      {
        for (int z = 0; z + 1 < this->Size[2]; ++z)
        {
          this->AddVoxel({ x, y, z });
        }
      }
    }
  }

  // Middle of the lattice edge.
  Point Position(int vertex) const
  {
    const int corner = vertex / 3;
    Point position = { double(corner / (this->Size[1] * this->Size[2])),
      double(corner / this->Size[2] % this->Size[1]), double(corner % this->Size[2]) };
    position[vertex % 3] += 0.5;
    return position;
  }

  bool ShareOuterFace(int vertex, int otherVertex) const
  {
    const Point a = this->Position(vertex);
    const Point b = this->Position(otherVertex);
    for (int axis = 0; axis < 3; ++axis)
    {
      if (a[axis] == b[axis] && (a[axis] == 0.0 || a[axis] == this->Size[axis] - 1.0))
      {
        return true;
      }
    }
    return false;
  }
};

Lattice MakeVoxel(unsigned insideBits)
{
  Lattice voxel({ 2, 2, 2 });
  for (int corner = 0; corner < CornersOfVoxel; ++corner)
  {
    voxel.Inside[corner] = (insideBits >> corner & 1u) != 0;
  }
  voxel.Polygonise();
  return voxel;
}

HalfEdges CountHalfEdges(const std::vector<Triangle>& triangles)
{
  HalfEdges counts;
  for (const Triangle& triangle : triangles)
  {
    for (int i = 0; i < 3; ++i)
    {
      ++counts[{ triangle[i], triangle[(i + 1) % 3] }];
    }
  }
  return counts;
}

// Number of bad mesh edges. An edge off the outer boundary has to be traversed exactly once in each
// direction, an edge on the boundary at most once.
int CountBadEdges(const Lattice& lattice)
{
  const HalfEdges counts = CountHalfEdges(lattice.Triangles);
  int bad = 0;
  for (const auto& [ends, count] : counts)
  {
    const bool opposite = counts.count({ ends.second, ends.first }) == 1;
    bad += count != 1 || opposite == lattice.ShareOuterFace(ends.first, ends.second);
  }
  return bad;
}

// Number of vertices whose triangles do not form one closed fan. The mesh must be closed and
// edge-manifold.
int CountBadVertices(const Lattice& lattice)
{
  std::map<int, std::map<int, int>> nextAround;
  for (const Triangle& triangle : lattice.Triangles)
  {
    for (int i = 0; i < 3; ++i)
    {
      nextAround[triangle[i]][triangle[(i + 1) % 3]] = triangle[(i + 2) % 3];
    }
  }
  int bad = 0;
  for (const auto& [vertex, next] : nextAround)
  {
    std::set<int> visited;
    for (int other = next.begin()->first; next.count(other) && visited.insert(other).second;)
    {
      other = next.at(other);
    }
    bad += visited.size() != next.size();
  }
  return bad;
}

Point Cross(const Point& a, const Point& b)
{
  return { a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0] };
}

double Dot(const Point& a, const Point& b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Point Minus(const Point& a, const Point& b)
{
  return { a[0] - b[0], a[1] - b[1], a[2] - b[2] };
}

double Volume(const Lattice& lattice)
{
  double volume = 0.0;
  for (const Triangle& t : lattice.Triangles)
  {
    const Point normal = Cross(lattice.Position(t[1]), lattice.Position(t[2]));
    volume += Dot(lattice.Position(t[0]), normal) / 6.0;
  }
  return volume;
}

// Signed distance of a corner from a triangle's plane, positive in front of it, times twice the
// triangle's area.
double Height(const Lattice& voxel, const Triangle& triangle, int corner)
{
  const Point first = voxel.Position(triangle[0]);
  const Point toSecond = Minus(voxel.Position(triangle[1]), first);
  const Point toThird = Minus(voxel.Position(triangle[2]), first);
  const Point position = { double(OffsetOfCorner(corner, 0)), double(OffsetOfCorner(corner, 1)),
    double(OffsetOfCorner(corner, 2)) };
  return Dot(Minus(position, first), Cross(toSecond, toThird));
}

TEST(TestCubeTriangles, EdgesFollowTheirNumbers)
{
  int wrong = 0;
  for (int edge = 0; edge < EdgesOfVoxel; ++edge)
  {
    int rank = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      const int lower = OffsetOfCorner(LowerCornerOfEdge[edge], axis);
      const int upper = OffsetOfCorner(UpperCornerOfEdge(edge), axis);
      const bool along = axis == AxisOfEdge(edge);
      wrong += upper - lower != (along ? 1 : 0);
      rank = along ? rank : 2 * rank + lower;
    }
    wrong += edge != 4 * AxisOfEdge(edge) + rank;
  }
  EXPECT_EQ(wrong, 0) << "edge e is 4 axis + 2 u + v and goes one step along its axis";
}

TEST(TestCubeTriangles, EveryCaseUsesExactlyItsCrossedEdges)
{
  int wrong = 0;
  for (unsigned insideBits = 0; insideBits < 256; ++insideBits)
  {
    std::set<int> crossed;
    for (int edge = 0; edge < EdgesOfVoxel; ++edge)
    {
      const unsigned lower = insideBits >> LowerCornerOfEdge[edge] & 1u;
      const unsigned upper = insideBits >> UpperCornerOfEdge(edge) & 1u;
      if (lower != upper)
      {
        crossed.insert(edge);
      }
    }
    const VoxelTriangles& triangles = TrianglesOfVoxel(insideBits);
    std::set<int> used;
    for (int t = 0; t < triangles.Count; ++t)
    {
      used.insert(triangles.Edge[t], triangles.Edge[t] + 3);
    }
    wrong += used != crossed;
  }
  EXPECT_EQ(wrong, 0) << "the vertices of each case are its crossed edges";
}

// A diagonal in a face would have two triangles of this voxel, and could have two more of the
// neighbour voxel.
TEST(TestCubeTriangles, OnlyInteriorEdgesOfAVoxelHaveTwoTriangles)
{
  int wrong = 0;
  for (unsigned insideBits = 0; insideBits < 256; ++insideBits)
  {
    wrong += CountBadEdges(MakeVoxel(insideBits));
  }
  EXPECT_EQ(wrong, 0) << "mesh edges have one triangle on a face, two in the interior";
}

TEST(TestCubeTriangles, LoneCornerIsCutOffByOneOutwardTriangle)
{
  for (int corner = 0; corner < CornersOfVoxel; ++corner)
  {
    const Lattice inside = MakeVoxel(1u << corner);
    const Lattice outside = MakeVoxel(255u ^ 1u << corner);
    EXPECT_TRUE(inside.Triangles.size() == 1) << "one inside corner gives one triangle";
    EXPECT_TRUE(outside.Triangles.size() == 1) << "one outside corner gives one triangle";
    EXPECT_LT(Height(inside, inside.Triangles.at(0), corner), 0.0) << "inside lies behind it";
    EXPECT_GT(Height(outside, outside.Triangles.at(0), corner), 0.0) << "outside lies before it";
  }
}

// Two inside corners are diagonally opposite on a face: the skin has two pieces there, not a
// bridge.
TEST(TestCubeTriangles, DiagonalInsideCornersAreSeparated)
{
  EXPECT_EQ(TrianglesOfVoxel(0b00001001).Count, 2) << "two triangles, one for each corner";
  EXPECT_EQ(TrianglesOfVoxel(0b11110110).Count, 4) << "their complement is bridged";
}

TEST(TestCubeTriangles, NeighboursFitForAllSigns)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    std::array<int, 3> size = { 2, 2, 2 };
    size[axis] = 3;
    int wrong = 0;
    for (unsigned signs = 0; signs < 1u << 12; ++signs)
    {
      Lattice pair(size);
      for (int corner = 0; corner < 12; ++corner)
      {
        pair.Inside[corner] = (signs >> corner & 1u) != 0;
      }
      pair.Polygonise();
      wrong += CountBadEdges(pair);
    }
    EXPECT_EQ(wrong, 0) << "each mesh edge off the boundary is used once in each direction";
  }
}

Lattice MakeRandomLattice(std::mt19937& random)
{
  Lattice lattice({ 6, 6, 6 });
  const unsigned share = 1 + random() % 15;
  for (int x = 1; x < 5; ++x)
  {
    for (int y = 1; y < 5; ++y)
    {
      for (int z = 1; z < 5; ++z)
      {
        lattice.Inside[(x * 6 + y) * 6 + z] = random() % 16 < share;
      }
    }
  }
  lattice.Inside[(3 * 6 + 3) * 6 + 3] = true;
  lattice.Polygonise();
  return lattice;
}

// The outer layer is outside, so that no mesh edge lies on the boundary.
TEST(TestCubeTriangles, RandomSignsGiveAClosedOutwardManifold)
{
  std::mt19937 random(1998);
  for (int i = 0; i < 200; ++i)
  {
    const Lattice lattice = MakeRandomLattice(random);
    EXPECT_EQ(CountBadEdges(lattice), 0) << "each mesh edge is used once in each direction";
    EXPECT_EQ(CountBadVertices(lattice), 0) << "the triangles around a vertex form one fan";
    EXPECT_GT(Volume(lattice), 0.0) << "the skin encloses its inside, not its outside";
  }
}
}
