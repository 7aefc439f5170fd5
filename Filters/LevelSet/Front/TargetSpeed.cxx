#include "Front/TargetSpeed.h"

#include "Front/NodePoints.h"
#include "Front/SubstepBuffers.h"
#include "Front/WeightedSamples.h"
#include "Leaves/LeafKernels.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

namespace activesurface
{

namespace
{

/** Factor from a sample to the speed. */
float RateOfSamples(const Motion& motion)
{
  return static_cast<float>(-motion.Attraction);
}

/** Sets the speed at the nodes with crossed edges. */
ACTIVE_ALWAYS_INLINE void ApplyCrossings(
  const LeafTable& table, std::size_t i, const Motion& motion, SubstepBuffers& buffers)
{
  WeightedSamples samples(motion.Paper);
  samples.Add(table, i, buffers);
  float* speed = buffers.SpeedOf(i);
  const float rate = RateOfSamples(motion);
  const LeafMask known = NodesWithCrossing(table, table[i]);
  known.ForEach([&](int node) ACTIVE_INLINED { speed[node] = samples.GetSpeed(node, rate); });
  buffers.Known[i] = buffers.NextKnown[i] = known;
}

/** Sets the speed at the nodes with points of their own. */
void ApplyNodePoints(
  const LeafTable& table, std::size_t i, const Motion& motion, SubstepBuffers& buffers)
{
  std::size_t sample = static_cast<std::size_t>(buffers.FirstSample[i]) +
    (SamplesCrossings(motion) ? table[i].Crossings : 0);
  float* speed = buffers.SpeedOf(i);
  const float rate = RateOfSamples(motion);
  NodesWithOwnPoint(table, table[i], motion)
    .ForEach(
      [&](int node)
      {
        const float value = buffers.Samples[sample++];
        speed[node] = std::isfinite(value) ? rate * value : 0.f;
      });
}

float LargestOf(const float* speed, const LeafMask& nodes)
{
  float largest = 0.f;
  nodes.ForEach([&](int node) { largest = std::max(largest, std::fabs(speed[node])); });
  return largest;
}

/** Sets the speeds at the nodes with samples in a leaf, and the largest of these speeds. */
struct ApplyLeafSamples
{
  const LeafTable& Table;
  const Motion& Parameters;
  SubstepBuffers& Buffers;

  ACTIVE_ALWAYS_INLINE void operator()(std::size_t i) const
  {
    float* speed = this->Buffers.SpeedOf(i);
    std::fill_n(speed, 512, 0.f); // speed of nodes that the extension does not reach
    LeafMask nodes;
    if (SamplesCrossings(this->Parameters))
    {
      ApplyCrossings(this->Table, i, this->Parameters, this->Buffers);
      nodes = this->Buffers.Known[i];
    }
    if (HasNodePoints(this->Parameters))
    {
      ApplyNodePoints(this->Table, i, this->Parameters, this->Buffers);
      nodes = nodes | NodesWithOwnPoint(this->Table, this->Table[i], this->Parameters);
    }
    this->Buffers.LargestSpeed[i] = LargestOf(speed, nodes);
  }
};

/** One sweep of the extension in one leaf: nodes with a known neighbour become known. */
class LeafExtension
{
public:
  ACTIVE_ALWAYS_INLINE LeafExtension(
    const LeafTable& table, std::size_t leaf, const SubstepBuffers& buffers)
    : Table(table)
    , Leaf(static_cast<std::int32_t>(leaf))
    , Buffers(buffers)
  {
  }

  /** Sets the speeds of the missing nodes that are reached, and returns these nodes. */
  ACTIVE_ALWAYS_INLINE LeafMask Extend(const LeafMask& missing, float* speed) const
  {
    const Neighbours<0> alongX(*this, missing);
    const Neighbours<1> alongY(*this, missing);
    const Neighbours<2> alongZ(*this, missing);
    const LeafMask front = alongX.GetReached() | alongY.GetReached() | alongZ.GetReached();
    const float* own = this->Table[this->Leaf].Value;
    front.ForEach(
      [&](int node) ACTIVE_INLINED
      {
        const float distance = std::fabs(own[node]);
        KnownSums sums;
        alongX.Add(node, distance, sums);
        alongY.Add(node, distance, sums);
        alongZ.Add(node, distance, sums);
        StoreRelaxed(
          sums.Weight > 0.f ? sums.Speed / sums.Weight : this->FindMean(node), speed + node);
      });
    return front;
  }

private:
  struct KnownSums
  {
    float Weight = 0.f;
    float Speed = 0.f;
  };

  /** The two neighbours of missing nodes on an axis, if known. */
  template <int Axis>
  class Neighbours
  {
  public:
    ACTIVE_ALWAYS_INLINE Neighbours(const LeafExtension& leaf, const LeafMask& missing)
      : Values(leaf.Table, leaf.Leaf, [&leaf](std::int32_t n) { return leaf.Table[n].Value; })
      , Speeds(leaf.Table, leaf.Leaf, [&leaf](std::int32_t n) { return leaf.Buffers.SpeedOf(n); })
      , Before(missing & leaf.SeeKnown<Axis, -1>())
      , After(missing & leaf.SeeKnown<Axis, 1>())
    {
    }

    ACTIVE_ALWAYS_INLINE LeafMask GetReached() const { return this->Before | this->After; }

    ACTIVE_ALWAYS_INLINE void Add(int node, float distance, KnownSums& sums) const
    {
      this->Add(node, -1, this->Before.Has(node), distance, sums);
      this->Add(node, 1, this->After.Has(node), distance, sums);
    }

  private:
    /** Adds without a branch: unknown neighbours have weight 0. */
    ACTIVE_ALWAYS_INLINE void Add(
      int node, int sign, bool known, float distance, KnownSums& sums) const
    {
      const float nearer = distance - std::fabs(this->Values.At(node, sign));
      const float weight = static_cast<float>(known) * std::max(nearer, 0.f);
      sums.Weight += weight;
      sums.Speed += weight * (known ? this->Speeds.At(node, sign) : 0.f);
    }

    const LeafLine<Axis> Values;
    const LeafLine<Axis> Speeds;
    const LeafMask Before;
    const LeafMask After;
  };

  /** Plain mean of the known neighbours, for nodes without a known neighbour nearer to the surface.
   */
  float FindMean(int node) const
  {
    float sum = 0.f, count = 0.f;
    for (int face = 0; face < 6; ++face)
    {
      const LeafTable::Place next = this->Table.Step(this->Leaf, node, face / 2, face % 2 ? 1 : -1);
      if (next.Leaf >= 0 && this->Buffers.Known[next.Leaf].Has(next.Node))
      {
        sum += this->Buffers.SpeedOf(next.Leaf)[next.Node];
        count += 1.f;
      }
    }
    return sum / count;
  }

  /** Returns the nodes with a known neighbour in this direction. */
  template <int Axis, int Sign>
  ACTIVE_ALWAYS_INLINE LeafMask SeeKnown() const
  {
    static const LeafMask nothing;
    const std::int32_t next = this->Table[this->Leaf].Neighbour[FaceNumber(Axis, Sign)];
    return Seen<Axis, Sign>(
      this->Buffers.Known[this->Leaf], next >= 0 ? this->Buffers.Known[next] : nothing);
  }

  const LeafTable& Table;
  const std::int32_t Leaf;
  const SubstepBuffers& Buffers;
};

struct ExtendLeaf
{
  const LeafTable& Table;
  SubstepBuffers& Buffers;
  std::atomic<bool>& Reached;
  std::atomic<bool>& Left;

  ACTIVE_ALWAYS_INLINE void operator()(std::size_t i) const
  {
    if (i + 1 < this->Table.Size())
    {
      FetchAhead(this->Table[i + 1].Value);
      FetchAhead(this->Buffers.SpeedOf(i + 1));
    }
    const LeafMask& known = this->Buffers.Known[i];
    this->Buffers.NextKnown[i] = known;
    const LeafMask missing = this->Table[i].Active.Without(known);
    if (!missing.Any())
    {
      return;
    }
    const LeafExtension extension(this->Table, i, this->Buffers);
    const LeafMask front = extension.Extend(missing, this->Buffers.SpeedOf(i));
    this->Buffers.NextKnown[i] = known | front;
    if (front.Any())
    {
      this->Reached.store(true, std::memory_order_relaxed);
    }
    if (missing.Without(front).Any())
    {
      this->Left.store(true, std::memory_order_relaxed);
    }
  }
};

/** Runs one sweep from nodes to their neighbours. Returns true if another sweep may reach more
 * active nodes. */
bool ExtendOnce(const LeafTable& table, const ActiveSet& set, SubstepBuffers& buffers)
{
  std::atomic<bool> reached{ false }, left{ false };
  ForEachLeaf(table, set.Affected, ExtendLeaf{ table, buffers, reached, left });
  std::swap(buffers.Known, buffers.NextKnown);
  return reached.load() && left.load();
}

}

void ApplySamples(
  const LeafTable& table, const LeafList& leaves, const Motion& motion, SubstepBuffers& buffers)
{
  const std::size_t size = table.Size();
  buffers.MakeRoomForNodes(size);
  buffers.Known.assign(size, LeafMask());
  buffers.NextKnown.assign(size, LeafMask());
  buffers.LargestSpeed.resize(size);
  ForEachLeaf(table, leaves, ApplyLeafSamples{ table, motion, buffers });
}

// Extended speeds are means of known speeds, so the largest speed of all leaves stays the same.
void ExtendSpeed(
  const LeafTable& table, const ActiveSet& set, const Motion& motion, SubstepBuffers& buffers)
{
  while (SamplesCrossings(motion) && !motion.Paper && ExtendOnce(table, set, buffers))
  {
  }
}

bool PullsInVain(const Motion& motion, const SubstepBuffers& buffers)
{
  const bool isHeld =
    motion.AreaControl == Control::Exact || motion.VolumeControl == Control::Exact;
  const std::vector<float>& samples = buffers.Samples;
  return isHeld && motion.Attraction > 0.0 && !samples.empty() && samples.front() > 0.f &&
    std::all_of(samples.begin(), samples.end(),
      [&samples](float sample) { return sample == samples.front(); });
}

float LargestSpeedAtSurface(const LeafTable& table, std::size_t i, const SubstepBuffers& buffers)
{
  const auto speedAt = [&](const LeafTable::Place& place)
  { return buffers.SpeedOf(place.Leaf)[place.Node]; };
  float largest = 0.f;
  for (int axis = 0; axis < 3; ++axis)
  {
    table[i].Edge[axis].ForEach(
      [&](int node)
      {
        const LeafTable::Place lower{ static_cast<std::int32_t>(i), node };
        const LeafTable::Place upper = table.Step(lower.Leaf, node, axis, 1);
        const float low = table[i].Value[node], high = table[upper.Leaf].Value[upper.Node];
        const float t = low / (low - high);
        const float speed = (1.f - t) * speedAt(lower) + t * speedAt(upper);
        largest = std::max(largest, std::fabs(speed));
      });
  }
  return largest;
}

}
