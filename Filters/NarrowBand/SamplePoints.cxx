#include "SamplePoints.h"

#include "SubstepBuffers.h"

#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>

namespace activesurface
{

void FindSamplePoints(
  const LeafTable& table, double voxelSize, std::size_t count, std::vector<double>& points)
{
  MakeRoom(points, 3 * count);
  table.ForEach(
    [&](std::size_t i)
    {
      const BandLeaf& leaf = table[i];
      double* point = points.data() + 3 * leaf.FirstCrossing;
      for (int axis = 0; axis < 3; ++axis)
      {
        leaf.Edge[axis].ForEach(
          [&](int node)
          {
            const LeafTable::Place upper = table.Step(static_cast<std::int32_t>(i), node, axis, 1);
            const float low = leaf.Value[node];
            const float high = table[upper.Leaf].Value[upper.Node];
            double at[3] = { double(leaf.Origin[0] + (node >> 6)),
              double(leaf.Origin[1] + ((node >> 3) & 7)), double(leaf.Origin[2] + (node & 7)) };
            at[axis] += double(low) / (double(low) - double(high));
            for (double x : at)
            {
              *point++ = voxelSize * x;
            }
          });
      }
    });
}

namespace
{

TargetSamples EvaluateBatch(
  const Target& target, std::size_t begin, std::size_t end, SubstepBuffers& buffers)
{
  double* values = buffers.Values.data();
  double* slopes = buffers.Slopes.data();
  target.Evaluate(end - begin, buffers.Points.data() + 3 * begin, values + begin, slopes + begin);
  TargetSamples samples;
  samples.Count = end - begin;
  for (std::size_t i = begin; i < end; ++i)
  {
    if (!std::isfinite(static_cast<float>(values[i])))
    {
      ++samples.Dropped;
    }
    else if (slopes[i] > samples.LargestSlope)
    {
      samples.LargestSlope = slopes[i];
    }
  }
  return samples;
}

TargetSamples Sum(const TargetSamples& a, const TargetSamples& b)
{
  return { a.Count + b.Count, a.Dropped + b.Dropped, std::max(a.LargestSlope, b.LargestSlope) };
}

}

TargetSamples EvaluateTarget(const Target& target, std::size_t count, SubstepBuffers& buffers)
{
  constexpr std::size_t batch = 512;
  MakeRoom(buffers.Values, count);
  MakeRoom(buffers.Slopes, count);
  if (!target.IsThreadSafe())
  {
    return count > 0 ? EvaluateBatch(target, 0, count, buffers) : TargetSamples();
  }
  return tbb::parallel_reduce(
    tbb::blocked_range<std::size_t>(0, count, batch), TargetSamples(),
    [&](const tbb::blocked_range<std::size_t>& range, const TargetSamples& soFar)
    { return Sum(soFar, EvaluateBatch(target, range.begin(), range.end(), buffers)); },
    Sum);
}

}
