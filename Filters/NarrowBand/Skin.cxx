#include "Skin.h"

#include "CubeTriangles.h"
#include "LeafTable.h"
#include "NarrowBand.h"
#include "SkinVoxels.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace activesurface
{

namespace
{

/** Number of the vertex on an edge of the voxel with this lower corner. */
std::int64_t VertexOnEdge(const LeafTable& table, std::int32_t leaf, int node, int edge)
{
  const int corner = LowerCornerOfEdge[edge], axis = AxisOfEdge(edge);
  const LeafTable::Place lower = table.Offset(leaf, node, corner >> 2, corner >> 1 & 1, corner & 1);
  const BandLeaf& owner = table[lower.Leaf];
  return static_cast<std::int64_t>(
    owner.FirstCrossing + owner.CrossingsBefore[axis] + owner.Edge[axis].Rank(lower.Node));
}

float ValueAt(const LeafTable& table, const LeafTable::Place& place)
{
  return place.Leaf >= 0 ? table[place.Leaf].Value[place.Node] : table.BackgroundOf(place.Leaf);
}

/** Adds weight * central gradient at a node. */
void AddGradient(
  const LeafTable& table, const LeafTable::Place& place, double weight, double gradient[3])
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const double ahead = ValueAt(table, table.Step(place.Leaf, place.Node, axis, 1));
    const double behind = ValueAt(table, table.Step(place.Leaf, place.Node, axis, -1));
    gradient[axis] += weight * (ahead - behind);
  }
}

void WriteNormal(const LeafTable& table, const LeafTable::Place& lower,
  const LeafTable::Place& upper, int axis, float* normal)
{
  const double low = ValueAt(table, lower), high = ValueAt(table, upper);
  const double t = low / (low - high);
  double gradient[3] = { 0.0, 0.0, 0.0 };
  AddGradient(table, lower, 1.0 - t, gradient);
  AddGradient(table, upper, t, gradient);
  double length =
    std::sqrt(gradient[0] * gradient[0] + gradient[1] * gradient[1] + gradient[2] * gradient[2]);
  if (!(length > 0.0))
  {
    gradient[axis] = low < 0.0 ? 1.0 : -1.0; // no gradient: at least from inside to outside
    length = 1.0;
  }
  for (int d = 0; d < 3; ++d)
  {
    normal[d] = static_cast<float>(gradient[d] / length);
  }
}

template <class Number>
void WriteVertices(
  const LeafTable& table, std::size_t i, double voxelSize, Number* points, float* normals)
{
  const BandLeaf& leaf = table[i];
  std::size_t vertex = leaf.FirstCrossing;
  for (int axis = 0; axis < 3; ++axis)
  {
    leaf.Edge[axis].ForEach(
      [&](int node)
      {
        const LeafTable::Place lower{ static_cast<std::int32_t>(i), node };
        const LeafTable::Place upper = table.Step(lower.Leaf, node, axis, 1);
        const double low = ValueAt(table, lower), high = ValueAt(table, upper);
        double at[3] = { double(leaf.Origin[0] + (node >> 6)),
          double(leaf.Origin[1] + ((node >> 3) & 7)), double(leaf.Origin[2] + (node & 7)) };
        at[axis] += low / (low - high);
        for (int d = 0; d < 3; ++d)
        {
          points[3 * vertex + d] = static_cast<Number>(voxelSize * at[d]);
        }
        if (normals)
        {
          WriteNormal(table, lower, upper, axis, normals + 3 * vertex);
        }
        ++vertex;
      });
  }
}

/** corners: where the first triangle of the leaf goes. */
void WriteTriangles(const LeafTable& table, std::size_t i, std::int64_t* corners)
{
  ForEachCrossedVoxel(table, i,
    [&](int node, unsigned bits)
    {
      const VoxelTriangles& triangles = TrianglesOfVoxel(bits);
      for (int t = 0; t < triangles.Count; ++t)
      {
        for (std::uint8_t edge : triangles.Edge[t])
        {
          *corners++ = VertexOnEdge(table, static_cast<std::int32_t>(i), node, edge);
        }
      }
    });
}

}

Skin::Skin(const NarrowBand& band)
  : Band(band)
{
  const LeafTable& table = band.GetLeaves();
  this->FirstTriangle.resize(table.Size() + 1);
  band.Run(
    [&]
    {
      table.ForEach(
        [&](std::size_t i)
        {
          std::size_t count = 0;
          ForEachCrossedVoxel(
            table, i, [&](int, unsigned bits) { count += TrianglesOfVoxel(bits).Count; });
          this->FirstTriangle[i + 1] = count;
        });
    });
  for (std::size_t i = 0; i < table.Size(); ++i)
  {
    this->FirstTriangle[i + 1] += this->FirstTriangle[i];
    for (int axis = 0; axis < 3; ++axis)
    {
      this->NumberOfPoints += table[i].Edge[axis].Count();
      this->FarthestNode =
        std::max(this->FarthestNode, std::abs(std::int64_t(table[i].Origin[axis])));
    }
  }
  this->NumberOfTriangles = this->FirstTriangle.back();
}

template <class Number>
void Skin::WriteAs(Number* points, float* normals, std::int64_t* corners) const
{
  const LeafTable& table = this->Band.GetLeaves();
  this->Band.Run(
    [&]
    {
      table.ForEach(
        [&](std::size_t i)
        {
          WriteVertices(table, i, this->Band.GetVoxelSize(), points, normals);
          WriteTriangles(table, i, corners + 3 * this->FirstTriangle[i]);
        });
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
