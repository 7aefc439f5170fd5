#include "Substep/WalledTarget.h"

#include "Substep/SubstepBuffers.h"

#include <algorithm>

namespace activesurface
{

void WalledTarget::Evaluate(
  std::size_t count, const double* points, const TargetResults& results) const
{
  this->Within.Evaluate(count, points, results);
  double *values = results.Values, *slopes = results.Slopes;
  for (std::size_t i = 0; i < count; ++i)
  {
    // In the target's own unit; where it is flat, as far from a distance, as a distance.
    const double slope = slopes[i] > 0.0 ? slopes[i] : 1.0;
    const double wall = slope * DistanceToWalls(this->Box, points + 3 * i);
    if (wall > values[i])
    {
      values[i] = wall;
      slopes[i] = slope;
      if (results.Velocities)
      {
        std::fill_n(results.Velocities + 3 * i, 3, 0.0); // the wall stands still
      }
    }
  }
}

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

}
