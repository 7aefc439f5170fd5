#include "Substep/SamplePoints.h"

#include "Leaves/LeafExchange.h"
#include "Leaves/LeafKernels.h"
#include "Leaves/LeafLine.h"
#include "Substep/SampleGradients.h"
#include "Substep/SubstepBuffers.h"

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

/** Transport: turns the value at a point into the inward target speed. drift: gets the part of the
 * target's velocity that is along the surface. Returns the square of the point's velocity. */
ACTIVE_ALWAYS_INLINE double TurnIntoSpeed(
  const Motion& motion, const double* normal, const double* velocity, double& value, float* drift)
{
  double carried[3], along = 0.0, square = 0.0;
  for (int d = 0; d < 3; ++d)
  {
    const bool counts = std::isfinite(velocity[0] + velocity[1] + velocity[2]);
    carried[d] = counts ? motion.Transport * velocity[d] : 0.0;
    along += normal[d] * carried[d];
  }
  const bool counts = std::isfinite(static_cast<float>(value));
  value = counts ? motion.Attraction * value - along : std::numeric_limits<double>::quiet_NaN();
  for (int d = 0; d < 3; ++d)
  {
    const double tangential = carried[d] - along * normal[d];
    drift[d] = static_cast<float>(tangential);
    square += tangential * tangential;
  }
  return counts ? square + value * value : 0.0;
}

/** Whether the target gives more than values and slopes. */
bool HasMoreSamples(const Motion& motion)
{
  return motion.Transport > 0.0 || HasTensionWeights(motion);
}

/** HasMore: the motion wants velocities or weights of tension too. */
template <bool HasMore>
struct SampleLeaf
{
  const SampledLattice& Lattice;
  const Motion& Parameters;
  const Target& Source;
  SubstepBuffers& Buffers;
  std::atomic<std::size_t>& Dropped;

  ACTIVE_ALWAYS_INLINE void operator()(std::size_t i) const
  {
    constexpr int most = SampleGradients::Most;
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
    if constexpr (HasMore)
    {
      this->Buffers.LargestVelocity[i] = 0.f;
    }
    if (count > 0)
    {
      if constexpr (HasMore)
      {
        this->EvaluateMore(i, count, points, { values, slopes });
      }
      else
      {
        this->Source.Evaluate(count, points, { values, slopes });
      }
      this->Store(i, count, values, slopes);
    }
  }

private:
  ACTIVE_ALWAYS_INLINE void EvaluateMore(
    std::size_t i, std::size_t count, const double* points, TargetResults results) const
  {
    double velocities[3 * SampleGradients::Most], weights[SampleGradients::Most];
    const Motion& motion = this->Parameters;
    const bool isCarried = motion.Transport > 0.0;
    results.Velocities = isCarried ? velocities : nullptr;
    results.TensionWeights = HasTensionWeights(motion) ? weights : nullptr;
    this->Source.Evaluate(count, points, results);
    if (isCarried)
    {
      this->Carry(i, count, velocities, results.Values);
    }
    for (std::size_t n = 0; results.TensionWeights && n < count; ++n)
    {
      const float weight = static_cast<float>(std::min(std::max(weights[n], 0.0), 1.0));
      this->Buffers.WeightSamples[this->Buffers.FirstSample[i] + n] =
        std::isnan(weights[n]) ? 1.f : weight;
    }
  }

  ACTIVE_ALWAYS_INLINE void Carry(
    std::size_t i, std::size_t count, const double* velocities, double* values) const
  {
    const LeafTable& table = this->Lattice.Leaves;
    const SampleGradients gradients(table, i, this->Parameters, PotentialOf{ table });
    float* drifts = this->Buffers.Drifts.data() + 3 * this->Buffers.FirstSample[i];
    double largest = 0.0;
    for (std::size_t n = 0; n < count; ++n)
    {
      double normal[3];
      gradients.GetDirection(n, normal);
      const double square =
        TurnIntoSpeed(this->Parameters, normal, velocities + 3 * n, values[n], drifts + 3 * n);
      largest = std::max(largest, square);
    }
    this->Buffers.LargestVelocity[i] = static_cast<float>(std::sqrt(largest));
  }

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

/** Numbers the points after those that there are, and makes room for them; returns how many. */
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
  const auto makeRoom = [before](std::vector<float>& room, std::size_t numbers)
  {
    if (before > 0)
    {
      room.resize(numbers);
    }
    else
    {
      MakeRoom(room, numbers);
    }
  };
  makeRoom(buffers.Samples, size);
  if (HasTensionWeights(motion))
  {
    makeRoom(buffers.WeightSamples, size);
  }
  if (motion.Transport > 0.0)
  {
    makeRoom(buffers.Drifts, 3 * size);
  }
  return size - before;
}

template <class Kernel>
void RunSamples(const SampledLattice& lattice, const LeafList& leaves, const Kernel& sample)
{
  if (sample.Source.IsThreadSafe())
  {
    ForEachLeaf(lattice.Leaves, leaves, sample);
  }
  else
  {
    ForEachLeafInTurn(lattice.Leaves, leaves, sample);
  }
}

/** Adds the samples of leaves that have none. */
TargetSamples AddSamples(const SampledLattice& lattice, const LeafList& leaves,
  const Motion& motion, const Target& target, SubstepBuffers& buffers)
{
  TargetSamples samples;
  samples.Count = NumberSamples(lattice.Leaves, leaves, motion, buffers);
  std::atomic<std::size_t> dropped{ 0 };
  if (HasMoreSamples(motion))
  {
    RunSamples(lattice, leaves, SampleLeaf<true>{ lattice, motion, target, buffers, dropped });
  }
  else
  {
    RunSamples(lattice, leaves, SampleLeaf<false>{ lattice, motion, target, buffers, dropped });
  }
  TellSamples(lattice.Leaves, leaves, motion, buffers);
  const std::array<std::int64_t, 1> own = { static_cast<std::int64_t>(dropped.load()) };
  samples.Dropped = static_cast<std::size_t>(SumOverRanks(lattice.Leaves, own)[0]);
  return samples;
}

}

// Only crossings have samples here, see MayShare.
void TellSamples(
  const LeafTable& table, const LeafList& leaves, const Motion& motion, SubstepBuffers& buffers)
{
  const auto visit = [&](std::size_t i, auto& pass)
  {
    const auto first = static_cast<std::size_t>(buffers.FirstSample[i]);
    const auto count = static_cast<std::size_t>(table[i].Crossings);
    pass(buffers.Samples.data() + first, count);
    if (HasTensionWeights(motion))
    {
      pass(buffers.WeightSamples.data() + first, count);
    }
  };
  const bool isHeld =
    motion.AreaControl == Control::Exact || motion.VolumeControl == Control::Exact;
  isHeld ? TellAll(table, leaves, visit) : TellNeighbours(table, leaves, visit); // PullsInVain
}

TargetSamples SampleLeaves(const SampledLattice& lattice, const LeafList& leaves,
  const Motion& motion, const Target& target, SubstepBuffers& buffers)
{
  buffers.Samples.clear();
  buffers.FirstSample.assign(lattice.Leaves.Size(), SubstepBuffers::NoSamples);
  buffers.LargestTargetSlope.resize(lattice.Leaves.Size());
  buffers.LargestVelocity.resize(HasMoreSamples(motion) ? lattice.Leaves.Size() : 0);
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
