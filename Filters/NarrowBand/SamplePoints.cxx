#include "SamplePoints.h"

#include "LeafKernels.h"
#include "LeafLine.h"
#include "SubstepBuffers.h"

#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>

namespace activesurface
{

namespace
{

struct FindPoints
{
  const LeafTable& Table;
  double VoxelSize;
  double* Points;

  ACTIVE_ALWAYS_INLINE void operator()(std::size_t i) const
  {
    double* point = this->Points + 3 * this->Table[i].FirstCrossing;
    this->AddEdges<0>(i, point);
    this->AddEdges<1>(i, point);
    this->AddEdges<2>(i, point);
  }

private:
  template <int Axis>
  ACTIVE_ALWAYS_INLINE void AddEdges(std::size_t i, double*& point) const
  {
    const BandLeaf& leaf = this->Table[i];
    const LeafLine<Axis> line(this->Table, static_cast<std::int32_t>(i),
      [this](std::int32_t n) { return this->Table[n].Value; });
    leaf.Edge[Axis].ForEach(
      [&](int node) ACTIVE_INLINED
      {
        const double low = leaf.Value[node], high = line.At(node, 1);
        double at[3] = { double(leaf.Origin[0] + (node >> 6)),
          double(leaf.Origin[1] + ((node >> 3) & 7)), double(leaf.Origin[2] + (node & 7)) };
        at[Axis] += low / (low - high);
        for (int d = 0; d < 3; ++d)
        {
          point[d] = this->VoxelSize * at[d];
        }
        point += 3;
      });
  }
};

}

void FindSamplePoints(
  const LeafTable& table, double voxelSize, std::size_t count, std::vector<double>& points)
{
  MakeRoom(points, 3 * count);
  ForEachLeaf(table, FindPoints{ table, voxelSize, points.data() });
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
