#include "Front/WalledTarget.h"

#include "Front/SubstepBuffers.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace activesurface
{

/** Distance beyond the walls, or depth in the obstacle if larger [world units]: positive where the
 * surface may not be; -infinity without walls and obstacle. */
double WalledTarget::DistanceBeyond(const double x[3]) const
{
  const double walls = this->Box.Present ? DistanceToWalls(this->Box, x) : -HUGE_VAL;
  return this->Solid ? std::max(walls, this->Solid->DepthAt(x)) : walls;
}

void WalledTarget::Evaluate(
  std::size_t count, const double* points, const TargetResults& results) const
{
  this->Wrapped.Evaluate(count, points, results);
  double *values = results.Values, *slopes = results.Slopes;
  for (std::size_t i = 0; i < count; ++i)
  {
    // The target's slope scales the distance to the target's unit; a flat target gets slope 1.
    const double slope = slopes[i] > 0.0 ? slopes[i] : 1.0;
    const double wall = slope * this->DistanceBeyond(points + 3 * i);
    if (wall > values[i])
    {
      values[i] = wall;
      slopes[i] = slope;
    }
  }
}

namespace
{

void ClampToWalls(const LeafTable& table, const ActiveSet& set, const Walls& walls,
  double voxelSize, SubstepBuffers& buffers)
{
  table.ForEach(set.Active,
    [&](std::size_t i)
    {
      const BandLeaf& leaf = table[i];
      float* next = buffers.NextOf(i);
      leaf.Active.ForEach(
        [&](int node)
        {
          const double x[3] = { voxelSize * (leaf.Origin[0] + (node >> 6)),
            voxelSize * (leaf.Origin[1] + ((node >> 3) & 7)),
            voxelSize * (leaf.Origin[2] + (node & 7)) };
          const double wall = DistanceToWalls(walls, x) / voxelSize;
          next[node] = std::max(next[node], static_cast<float>(wall));
        });
    });
}

Obstacle::LeafOrigin OriginOf(const BandLeaf& leaf)
{
  return { leaf.Origin[0], leaf.Origin[1], leaf.Origin[2] };
}

std::vector<Obstacle::LeafOrigin> FindUnknown(
  const LeafTable& table, const LeafList& leaves, const Obstacle& obstacle)
{
  std::vector<Obstacle::LeafOrigin> unknown;
  for (const std::int32_t i : leaves)
  {
    if (!obstacle.IsKnown(OriginOf(table[i])))
    {
      unknown.push_back(OriginOf(table[i]));
    }
  }
  return unknown;
}

void ClampToObstacle(
  const LeafTable& table, const ActiveSet& set, Obstacle* obstacle, SubstepBuffers& buffers)
{
  obstacle->SampleLeaves(FindUnknown(table, set.Active, *obstacle));
  table.ForEach(set.Active,
    [&](std::size_t i)
    {
      if (const float* depths = obstacle->FindDepths(OriginOf(table[i])))
      {
        float* next = buffers.NextOf(i);
        table[i].Active.ForEach([&](int node) { next[node] = std::max(next[node], depths[node]); });
      }
    });
}

}

void ClampToBounds(const SurfaceBounds& bounds, const LeafTable& table, const ActiveSet& set,
  SubstepBuffers& buffers)
{
  if (bounds.Box.Present)
  {
    ClampToWalls(table, set, bounds.Box, bounds.VoxelSize, buffers);
  }
  if (bounds.Solid)
  {
    ClampToObstacle(table, set, bounds.Solid, buffers);
  }
}

void CheckObstacle(const LeafTable& table, Obstacle* obstacle)
{
  if (obstacle)
  {
    const LeafList all = table.FindAll([](std::size_t) { return true; });
    obstacle->SampleLeaves(FindUnknown(table, all, *obstacle));
    obstacle->Check();
  }
}

}
