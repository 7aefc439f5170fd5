#include "Start/LatticeFunction.h"

#include <algorithm>
#include <cmath>

namespace activesurface
{

void LatticeFunction::Evaluate(
  const openvdb::Coord& origin, const LeafMask& nodes, double* values) const
{
  std::vector<openvdb::Coord> places;
  places.reserve(512);
  nodes.ForEach(
    [&](int node) { places.push_back(origin.offsetBy(node >> 6, (node >> 3) & 7, node & 7)); });
  double results[512];
  this->EvaluateNodes(places.size(), places.data(), results);
  const double* result = results;
  nodes.ForEach([&](int node) { values[node] = *result++; });
}

LeafMask LatticeFunction::FindInside(const openvdb::Coord& origin, const LeafMask& nodes) const
{
  double values[512];
  this->Evaluate(origin, nodes, values);
  LeafMask inside;
  nodes.ForEach(
    [&](int node)
    {
      if (values[node] < 0.0)
      {
        inside.Add(node);
      }
    });
  return inside;
}

void LatticeFunction::Evaluate(
  const std::vector<openvdb::Coord>& nodes, std::vector<double>& values) const
{
  constexpr std::size_t atOnce = 512;
  values.resize(nodes.size());
  this->ForEach(0, (nodes.size() + atOnce - 1) / atOnce,
    [&](std::size_t batch)
    {
      const std::size_t first = atOnce * batch;
      this->EvaluateNodes(
        std::min(atOnce, nodes.size() - first), nodes.data() + first, values.data() + first);
    });
}

void LatticeFunction::EvaluateNodes(
  std::size_t count, const openvdb::Coord* nodes, double* values) const
{
  std::vector<double> points;
  points.reserve(3 * count);
  for (std::size_t i = 0; i < count; ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      points.push_back(this->VoxelSize * nodes[i][axis]);
    }
  }
  if (count > 0)
  {
    this->Function.Evaluate(count, points.data(), values);
    this->Evaluations.fetch_add(count, std::memory_order_relaxed);
  }
  for (std::size_t i = 0; this->Limits && i < count; ++i)
  {
    values[i] = this->Limits->Closes(nodes[i]) ? std::fabs(values[i]) : values[i];
  }
}

}
