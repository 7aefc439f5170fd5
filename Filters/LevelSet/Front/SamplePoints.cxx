#include "Front/SamplePoints.h"

#include "Front/SubstepBuffers.h"
#include "Leaves/LeafKernels.h"
#include "Leaves/LeafLine.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <limits>

namespace activesurface
{

namespace
{

/** World positions (x y z) of a leaf's crossings. */
class CrossingPoints
{
public:
  ACTIVE_ALWAYS_INLINE CrossingPoints(const LeafTable& table, std::size_t i, double voxelSize)
    : Table(table)
    , Leaf(i)
    , VoxelSize(voxelSize)
  {
  }

  ACTIVE_ALWAYS_INLINE double* Write(double* point) const
  {
    return this->WriteAxis<2>(this->WriteAxis<1>(this->WriteAxis<0>(point)));
  }

private:
  template <int Axis>
  ACTIVE_ALWAYS_INLINE double* WriteAxis(double* point) const
  {
    const BandLeaf& leaf = this->Table[this->Leaf];
    const LeafLine<Axis> line(this->Table, static_cast<std::int32_t>(this->Leaf),
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
    return point;
  }

  const LeafTable& Table;
  const std::size_t Leaf;
  const double VoxelSize;
};

struct SampleLeaf
{
  const SampledLattice& Lattice;
  const Motion& Parameters;
  const activesurface::Target& Target;
  SubstepBuffers& Buffers;
  std::atomic<std::size_t>& Dropped;

  ACTIVE_ALWAYS_INLINE void operator()(std::size_t i) const
  {
    constexpr int most = 4 * 512; // three edges a node, and the node itself
    double points[3 * most], values[most], slopes[most];
    const double* end = points;
    if (SamplesCrossings(this->Parameters))
    {
      end = CrossingPoints(this->Lattice.Leaves, i, this->Lattice.VoxelSize).Write(points);
    }
    if (HasNodePoints(this->Parameters))
    {
      end = WriteNodePoints(this->Lattice, i, this->Parameters, points + (end - points));
    }
    const std::size_t count = static_cast<std::size_t>(end - points) / 3;
    this->Buffers.LargestTargetSlope[i] = 0.0;
    if (count > 0)
    {
      this->Target.Evaluate(count, points, { values, slopes });
      this->Store(i, count, values, slopes);
    }
  }

private:
  ACTIVE_ALWAYS_INLINE void Store(
    std::size_t i, std::size_t count, const double* values, const double* slopes) const
  {
    float* sample = this->Buffers.Samples.data() + this->Buffers.FirstSample[i];
    double largest = 0.0;
    std::size_t dropped = 0;
    for (std::size_t n = 0; n < count; ++n)
    {
      sample[n] = static_cast<float>(values[n]);
      const bool counts = std::isfinite(sample[n]);
      dropped += !counts;
      largest = counts && slopes[n] > largest ? slopes[n] : largest;
    }
    this->Buffers.LargestTargetSlope[i] = largest;
    if (dropped > 0)
    {
      this->Dropped.fetch_add(dropped, std::memory_order_relaxed);
    }
  }
};

/** Numbers the points of these leaves, beginning after existing points, and allocates the samples.
 * Returns the count of new points. */
std::size_t NumberSamples(
  const LeafTable& table, const LeafList& leaves, const Motion& motion, SubstepBuffers& buffers)
{
  const std::size_t before = buffers.Samples.size();
  std::size_t size = before;
  for (const std::int32_t i : leaves)
  {
    buffers.FirstSample[i] = static_cast<std::int64_t>(size);
    size += SamplesCrossings(motion) ? table[i].Crossings : 0;
    size += HasNodePoints(motion) ? NodesWithOwnPoint(table, table[i], motion).Count() : 0;
  }
  if (before > 0)
  {
    buffers.Samples.resize(size);
  }
  else
  {
    MakeRoom(buffers.Samples, size);
  }
  return size - before;
}

template <class Kernel>
void RunSamples(const SampledLattice& lattice, const LeafList& leaves, const Kernel& sample)
{
  if (sample.Target.IsThreadSafe())
  {
    ForEachLeaf(lattice.Leaves, leaves, sample);
  }
  else
  {
    ForEachLeafInTurn(leaves, sample);
  }
}

/** Adds the samples of leaves without samples. */
TargetSamples AddSamples(const SampledLattice& lattice, const LeafList& leaves,
  const Motion& motion, const Target& target, SubstepBuffers& buffers)
{
  TargetSamples samples;
  samples.Count = NumberSamples(lattice.Leaves, leaves, motion, buffers);
  std::atomic<std::size_t> dropped{ 0 };
  RunSamples(lattice, leaves, SampleLeaf{ lattice, motion, target, buffers, dropped });
  samples.Dropped = dropped.load();
  return samples;
}

}

TargetSamples SampleLeaves(const SampledLattice& lattice, const LeafList& leaves,
  const Motion& motion, const Target& target, SubstepBuffers& buffers)
{
  buffers.Samples.clear();
  buffers.FirstSample.assign(lattice.Leaves.Size(), SubstepBuffers::NoSamples);
  buffers.LargestTargetSlope.resize(lattice.Leaves.Size());
  return AddSamples(lattice, leaves, motion, target, buffers);
}

TargetSamples SampleMore(const SampledLattice& lattice, const LeafList& leaves,
  const Motion& motion, const Target& target, SubstepBuffers& buffers)
{
  LeafList unsampled;
  std::copy_if(leaves.begin(), leaves.end(), std::back_inserter(unsampled),
    [&](std::int32_t i) { return buffers.FirstSample[i] == SubstepBuffers::NoSamples; });
  return AddSamples(lattice, unsampled, motion, target, buffers);
}

}
