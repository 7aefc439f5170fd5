#include "Front/SkinMeasure.h"

#include "Front/SkinVoxels.h"
#include "Leaves/LeafKernels.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace activesurface
{

namespace
{

struct Vector
{
  double X, Y, Z;
};

Vector Difference(const Vector& a, const Vector& b)
{
  return { a.X - b.X, a.Y - b.Y, a.Z - b.Z };
}

Vector Cross(const Vector& a, const Vector& b)
{
  return { a.Y * b.Z - a.Z * b.Y, a.Z * b.X - a.X * b.Z, a.X * b.Y - a.Y * b.X };
}

double Dot(const Vector& a, const Vector& b)
{
  return a.X * b.X + a.Y * b.Y + a.Z * b.Z;
}

/** Crossings of the edges of a leaf's voxels. */
struct CrossingsOfLeaf
{
  double Origin[3];
  double Along[3 * CornersOfLeaf]; // by EdgePlace, for crossed edges: 0 to 1

  ACTIVE_ALWAYS_INLINE CrossingsOfLeaf(const LeafTable& table, std::size_t i)
  {
    const openvdb::Coord& origin = table[i].Origin;
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Origin[axis] = double(origin[axis]);
    }
    ForEachCrossedEdge(table, i,
      [&](const CrossedEdge& edge) ACTIVE_INLINED
      {
        const LeafTable::Place upper = table.Step(edge.Leaf, edge.Node, edge.Axis, 1);
        const double low = table[edge.Leaf].Value[edge.Node];
        const double high = table[upper.Leaf].Value[upper.Node];
        this->Along[edge.Place] = low / (low - high);
      });
  }

  /** Returns the crossing of an edge of the voxel with this lower corner. */
  ACTIVE_ALWAYS_INLINE Vector At(int node, int edge) const
  {
    const int corner = LowerCornerOfEdge[edge];
    double at[3] = { this->Origin[0] + ((node >> 6) + (corner >> 2)),
      this->Origin[1] + (((node >> 3) & 7) + (corner >> 1 & 1)),
      this->Origin[2] + ((node & 7) + (corner & 1)) };
    at[AxisOfEdge(edge)] += this->Along[CornerPlace(node) + PlaceOfEdge[edge]];
    return { at[0], at[1], at[2] };
  }
};

ACTIVE_ALWAYS_INLINE void AddTriangle(const Vector corners[3], SkinMeasure& sum)
{
  const Vector twiceArea =
    Cross(Difference(corners[1], corners[0]), Difference(corners[2], corners[0]));
  sum.Area += .5 * std::sqrt(Dot(twiceArea, twiceArea));
  sum.Volume += Dot(corners[0], twiceArea) / 6.0;
}

struct MeasureLeaf
{
  const LeafTable& Table;
  SkinMeasure* Parts;

  ACTIVE_ALWAYS_INLINE void operator()(std::size_t i) const
  {
    SkinMeasure sum;
    if (this->Table[i].UpToLayer[0].Any())
    {
      const CrossingsOfLeaf crossings(this->Table, i);
      const VoxelTriangles* all = &TrianglesOfVoxel(0);
      ForEachCrossedVoxel(this->Table, i,
        [&](int node, unsigned bits) ACTIVE_INLINED
        {
          const VoxelTriangles& triangles = all[bits];
          for (int t = 0; t < triangles.Count; ++t)
          {
            const std::uint8_t* edge = triangles.Edge[t];
            const Vector corners[3] = { crossings.At(node, edge[0]), crossings.At(node, edge[1]),
              crossings.At(node, edge[2]) };
            AddTriangle(corners, sum);
          }
        });
    }
    this->Parts[i] = sum;
  }
};

}

SkinSums SumSkin(const LeafTable& table)
{
  std::vector<SkinMeasure> parts(table.Size());
  ForEachLeaf(table, MeasureLeaf{ table, parts.data() });
  SkinSums sums;
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    if (!table.SummaryOf(i).IsForeign)
    {
      sums.Area.Add(parts[i].Area);
      sums.Volume.Add(parts[i].Volume);
    }
  }
  return sums;
}

}
