#include "Surface/Skin.h"

#include "BandPart.h"
#include "Front/SkinVoxels.h"
#include "Leaves/LeafBlock.h"
#include "Leaves/LeafKernels.h"
#include "NarrowBand.h"
#include "Ranks/Domain.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace activesurface
{

namespace
{

constexpr int StrideInBlock[3] = { LeafBlock::X, LeafBlock::Y, LeafBlock::Z };

/** Adds weight * twice the central gradient at a node of the block. */
ACTIVE_ALWAYS_INLINE void AddGradient(const float* u, double weight, double gradient[3])
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const double ahead = u[StrideInBlock[axis]], behind = u[-StrideInBlock[axis]];
    gradient[axis] += weight * (ahead - behind);
  }
}

/** Normals of a leaf's vertices on edges along an axis. Arrays allow vectorised roots and
 * divisions. */
class NormalsOfAxis
{
public:
  ACTIVE_ALWAYS_INLINE explicit NormalsOfAxis(int axis)
    : Axis(axis)
  {
  }

  /** t: position of the crossing from the lower node (0) to the upper node (1). */
  ACTIVE_ALWAYS_INLINE void Add(const float* lower, const float* upper, double t)
  {
    double gradient[3] = { 0.0, 0.0, 0.0 };
    AddGradient(lower, 1.0 - t, gradient);
    AddGradient(upper, t, gradient);
    this->X[this->Count] = gradient[0];
    this->Y[this->Count] = gradient[1];
    this->Z[this->Count] = gradient[2];
    this->IsInside[this->Count] = *lower < 0.f;
    ++this->Count;
  }

  ACTIVE_ALWAYS_INLINE void Write(float* normals)
  {
    float x[512], y[512], z[512];
    for (int k = 0; k < this->Count; ++k)
    {
      const double length =
        std::sqrt(this->X[k] * this->X[k] + this->Y[k] * this->Y[k] + this->Z[k] * this->Z[k]);
      x[k] = static_cast<float>(this->X[k] / length);
      y[k] = static_cast<float>(this->Y[k] / length);
      z[k] = static_cast<float>(this->Z[k] / length);
      this->X[k] = length;
    }
    for (int k = 0; k < this->Count; ++k, normals += 3)
    {
      normals[0] = x[k];
      normals[1] = y[k];
      normals[2] = z[k];
      if (!(this->X[k] > 0.0))
      {
        // Without a gradient the normal is along the edge, from inside to outside.
        std::fill_n(normals, 3, 0.f);
        normals[this->Axis] = this->IsInside[k] ? 1.f : -1.f;
      }
    }
  }

private:
  const int Axis;
  int Count = 0;
  double X[512], Y[512], Z[512]; //< gradients
  bool IsInside[512];            //< side of the lower node
};

/** Returns the least distance of a vertex from the ends of its edge [voxels]. Without this
 * distance, all vertices on the edges of a node where the potential is 0 would coincide, and their
 * triangles would have no area. At the coordinate c, rounding moves a vertex by at most half of c *
 * epsilon. Vertices at least 2 c * epsilon from the node therefore stay apart, and triangles keep
 * their orientation. */
template <class Number>
double MarginOfVertices(std::int64_t farthestNode)
{
  constexpr double least = 1.0 / (1 << 13);
  return std::max(least, 2.0 * std::numeric_limits<Number>::epsilon() * double(farthestNode + 8));
}

/** Writes the vertices of a leaf: where the surface crosses the edges that begin in the leaf. */
template <class Number>
struct WriteVertices
{
  const LeafTable& Table;
  double VoxelSize;
  double Margin;
  Number* Points;
  float* Normals;

  ACTIVE_ALWAYS_INLINE void operator()(std::size_t i) const
  {
    const BandLeaf& leaf = this->Table[i];
    if (leaf.Crossings == 0)
    {
      return;
    }
    LeafBlock block;
    block.Gather(this->Table, leaf);
    for (int axis = 0; axis < 3; ++axis)
    {
      this->WriteAxis(leaf, block, axis);
    }
  }

private:
  ACTIVE_ALWAYS_INLINE void WriteAxis(const BandLeaf& leaf, const LeafBlock& block, int axis) const
  {
    const std::size_t first = leaf.FirstCrossing + leaf.CrossingsBefore[axis];
    Number* point = this->Points + 3 * first;
    NormalsOfAxis normals(axis);
    leaf.Edge[axis].ForEach(
      [&](int node) ACTIVE_INLINED
      {
        const int x = node >> 6, y = (node >> 3) & 7, z = node & 7;
        const float* lower = block.Row(x, y) + z;
        const float* upper = lower + StrideInBlock[axis];
        const double low = *lower, high = *upper;
        const double t = std::min(std::max(low / (low - high), this->Margin), 1.0 - this->Margin);
        double at[3] = { double(leaf.Origin[0] + x), double(leaf.Origin[1] + y),
          double(leaf.Origin[2] + z) };
        at[axis] += t;
        for (int d = 0; d < 3; ++d)
        {
          point[d] = static_cast<Number>(this->VoxelSize * at[d]);
        }
        point += 3;
        if (this->Normals)
        {
          normals.Add(lower, upper, t);
        }
      });
    if (this->Normals)
    {
      normals.Write(this->Normals + 3 * first);
    }
  }
};

struct CountTriangles
{
  const LeafTable& Table;
  std::size_t* Counts;

  ACTIVE_ALWAYS_INLINE void operator()(std::size_t i) const
  {
    const VoxelTriangles* triangles = &TrianglesOfVoxel(0);
    std::size_t count = 0;
    ForEachCrossedVoxel(
      this->Table, i, [&](int, unsigned bits) ACTIVE_INLINED { count += triangles[bits].Count; });
    this->Counts[i] = count;
  }
};

struct WriteTriangles
{
  const LeafTable& Table;
  const std::size_t* First; //< number of the first triangle of each leaf
  std::int64_t* Corners;

  ACTIVE_ALWAYS_INLINE void operator()(std::size_t i) const
  {
    if (this->First[i] == this->First[i + 1])
    {
      return;
    }
    std::int64_t vertex[3 * CornersOfLeaf]; // by EdgePlace, where the edge is crossed
    ForEachCrossedEdge(this->Table, i,
      [&vertex](const CrossedEdge& edge) ACTIVE_INLINED { vertex[edge.Place] = edge.Number; });
    const VoxelTriangles* all = &TrianglesOfVoxel(0);
    std::int64_t* corner = this->Corners + 3 * this->First[i];
    ForEachCrossedVoxel(this->Table, i,
      [&](int node, unsigned bits) ACTIVE_INLINED
      {
        const VoxelTriangles& triangles = all[bits];
        const int place = CornerPlace(node);
        for (int t = 0; t < triangles.Count; ++t)
        {
          for (std::uint8_t edge : triangles.Edge[t])
          {
            *corner++ = vertex[place + PlaceOfEdge[edge]];
          }
        }
      });
  }
};

/** Writes the vertices and triangles of a leaf while its neighbours' values are in the caches. */
template <class Number>
struct WriteLeaf
{
  const WriteVertices<Number>& Vertices;
  const WriteTriangles& Triangles;

  ACTIVE_ALWAYS_INLINE void operator()(std::size_t i) const
  {
    this->Vertices(i);
    this->Triangles(i);
  }
};

}

Skin::Skin(const NarrowBand& band)
  : Band(band)
{
  const LeafTable& table = band.GetLeaves();
  this->FirstTriangle.resize(table.Size() + 1);
  band.Run([&] { ForEachLeaf(table, CountTriangles{ table, this->FirstTriangle.data() + 1 }); });
  for (std::size_t i = 0; i < table.Size(); ++i)
  {
    this->FirstTriangle[i + 1] += this->FirstTriangle[i];
    this->NumberOfPoints += table[i].Crossings;
    for (int axis = 0; axis < 3; ++axis)
    {
      this->FarthestNode =
        std::max(this->FarthestNode, std::abs(std::int64_t(table[i].Origin[axis])));
    }
  }
  this->NumberOfTriangles = this->FirstTriangle.back();
}

std::vector<Skin::TriangleRange> Skin::ListTriangles(int rank, int ranks) const
{
  const LeafTable& table = this->Band.GetLeaves();
  std::vector<TriangleRange> ranges;
  if (!this->Band.GetPart())
  {
    const std::vector<std::size_t> leaves = ShareLeaves(this->FirstTriangle, ranks);
    const auto i = static_cast<std::size_t>(rank);
    ranges.push_back({ this->FirstTriangle[leaves[i]], this->FirstTriangle[leaves[i + 1]] });
    return ranges;
  }
  for (std::size_t i = 0; i < table.Size(); ++i)
  {
    const TriangleRange leaf = { this->FirstTriangle[i], this->FirstTriangle[i + 1] };
    if (table.SummaryOf(i).IsForeign || leaf.First == leaf.Last)
    {
      continue;
    }
    if (ranges.empty() || ranges.back().Last != leaf.First)
    {
      ranges.push_back(leaf);
    }
    ranges.back().Last = leaf.Last;
  }
  return ranges;
}

std::vector<std::int64_t> Skin::NumberVertices() const
{
  return activesurface::NumberVertices(this->Band.GetLeaves(), this->Band.GetPart());
}

template <class Number>
void Skin::WriteAs(Number* points, float* normals, std::int64_t* corners) const
{
  const LeafTable& table = this->Band.GetLeaves();
  this->Band.Run(
    [&]
    {
      const WriteVertices<Number> vertices{ table, this->Band.GetVoxelSize(),
        MarginOfVertices<Number>(this->FarthestNode), points, normals };
      const WriteTriangles triangles{ table, this->FirstTriangle.data(), corners };
      ForEachLeaf(table, WriteLeaf<Number>{ vertices, triangles });
    });
}

void Skin::Write(float* points, float* normals, std::int64_t* corners) const
{
  this->WriteAs(points, normals, corners);
}

void Skin::Write(double* points, float* normals, std::int64_t* corners) const
{
  this->WriteAs(points, normals, corners);
}

}
