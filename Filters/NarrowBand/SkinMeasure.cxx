#include "SkinMeasure.h"

#include "SkinVoxels.h"

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

/** Where the surface crosses an edge of the voxel with this lower corner; from the reference. */
Vector CrossingOnEdge(
  const LeafTable& table, std::int32_t leaf, int node, int edge, const openvdb::Coord& reference)
{
  const int corner = LowerCornerOfEdge[edge], axis = AxisOfEdge(edge);
  const LeafTable::Place lower = table.Offset(leaf, node, corner >> 2, corner >> 1 & 1, corner & 1);
  const LeafTable::Place upper = table.Step(lower.Leaf, lower.Node, axis, 1);
  const double low = table[lower.Leaf].Value[lower.Node];
  const double high = table[upper.Leaf].Value[upper.Node];
  const openvdb::Coord origin = table[leaf].Origin - reference;
  double at[3] = { double(origin[0] + (node >> 6) + (corner >> 2)),
    double(origin[1] + ((node >> 3) & 7) + (corner >> 1 & 1)),
    double(origin[2] + (node & 7) + (corner & 1)) };
  at[axis] += low / (low - high);
  return { at[0], at[1], at[2] };
}

void AddTriangle(const Vector corners[3], SkinMeasure& sum)
{
  const Vector twiceArea =
    Cross(Difference(corners[1], corners[0]), Difference(corners[2], corners[0]));
  sum.Area += .5 * std::sqrt(Dot(twiceArea, twiceArea));
  sum.Volume += Dot(corners[0], twiceArea) / 6.0;
}

SkinMeasure MeasureLeaf(const LeafTable& table, std::size_t i, const openvdb::Coord& reference)
{
  SkinMeasure sum;
  ForEachCrossedVoxel(table, i,
    [&](int node, unsigned bits)
    {
      const VoxelTriangles& triangles = TrianglesOfVoxel(bits);
      for (int t = 0; t < triangles.Count; ++t)
      {
        Vector corners[3];
        for (int c = 0; c < 3; ++c)
        {
          corners[c] = CrossingOnEdge(
            table, static_cast<std::int32_t>(i), node, triangles.Edge[t][c], reference);
        }
        AddTriangle(corners, sum);
      }
    });
  return sum;
}

}

SkinMeasure MeasureSkin(const LeafTable& table)
{
  // Any point will do for a closed surface; one nearby keeps the sums small. Leaves without surface
  // do not count: whether they are still there depends on what was asked for before.
  std::size_t first = 0;
  while (first < table.Size() && !table[first].Upto[0].Any())
  {
    ++first;
  }
  SkinMeasure total;
  if (first == table.Size())
  {
    return total;
  }
  const openvdb::Coord reference = table[first].Origin;
  std::vector<SkinMeasure> parts(table.Size());
  table.ForEach([&](std::size_t i) { parts[i] = MeasureLeaf(table, i, reference); });
  for (const SkinMeasure& part : parts)
  {
    total.Area += part.Area;
    total.Volume += part.Volume;
  }
  return total;
}

}
