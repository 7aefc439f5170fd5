#include "TargetSpeed.h"

#include "NodePoints.h"
#include "SubstepBuffers.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace activesurface
{

namespace
{

/** Sums of weight and weight * value of the sample points around each node of a leaf. */
struct WeightedSamples
{
  std::array<float, 512> Weight{};
  std::array<float, 512> Sum{};
  bool Plain = false; //< all weights are 1, as in the paper

  /** own: potential at the node, other: across the crossed edge. */
  void Add(int node, float own, float other, double value)
  {
    constexpr float smallest = 1e-6f; // below, the crossing counts as on the node
    const float sample = static_cast<float>(value);
    if (!std::isfinite(sample))
    {
      return;
    }
    const float t = this->Plain ? 1.f : std::max(own / (own - other), smallest);
    const float weight = 1.f / (t * t);
    this->Weight[node] += weight;
    this->Sum[node] += weight * sample;
  }
};

/** Edges that begin in the leaf before this one and end on its first plane. */
void AddIncomingEdges(const LeafTable& table, const BandLeaf& leaf, int axis, const double* values,
  WeightedSamples& samples, LeafMask& known)
{
  const std::int32_t number = leaf.Neighbour[FaceNumber(axis, -1)];
  if (number < 0)
  {
    return;
  }
  const BandLeaf& before = table[number];
  const double* first = values + before.FirstCrossing + before.CrossingsBefore[axis];
  LeafMask lastPlane;
  for (int x = axis == 0 ? 7 : 0; x < 8; ++x)
  {
    lastPlane.Word[x] = axis == 0 ? ~0ull : axis == 1 ? 0xffull << 56 : 0x8080808080808080ull;
  }
  const LeafMask& edges = before.Edge[axis];
  (edges & lastPlane)
    .ForEach(
      [&](int lower)
      {
        const int node = lower - 7 * Stride(axis);
        samples.Add(node, leaf.Value[node], before.Value[lower], first[edges.Rank(lower)]);
        known.Add(node);
      });
}

void AddOwnEdges(const LeafTable& table, const BandLeaf& leaf, int axis, const double* values,
  WeightedSamples& samples, LeafMask& known)
{
  const std::int32_t after = leaf.Neighbour[FaceNumber(axis, 1)];
  const int stride = Stride(axis);
  const double* value = values + leaf.FirstCrossing + leaf.CrossingsBefore[axis];
  leaf.Edge[axis].ForEach(
    [&](int node)
    {
      const bool inside = (node / stride) % 8 < 7;
      const float own = leaf.Value[node];
      const float other =
        inside ? leaf.Value[node + stride] : table[after].Value[node - 7 * stride];
      samples.Add(node, own, other, *value);
      known.Add(node);
      if (inside)
      {
        samples.Add(node + stride, other, own, *value);
        known.Add(node + stride);
      }
      ++value;
    });
}

/** Speed at the nodes with crossed edges. */
void TakeSamples(
  const LeafTable& table, std::size_t i, const Motion& motion, SubstepBuffers& buffers)
{
  const BandLeaf& leaf = table[i];
  WeightedSamples samples;
  samples.Plain = motion.Paper;
  LeafMask known;
  for (int axis = 0; axis < 3; ++axis)
  {
    AddIncomingEdges(table, leaf, axis, buffers.Values.data(), samples, known);
    AddOwnEdges(table, leaf, axis, buffers.Values.data(), samples, known);
  }
  float* speed = buffers.Speed.data() + 512 * i;
  const float rate = static_cast<float>(-motion.Attraction);
  known.ForEach(
    [&](int node)
    {
      const float weight = samples.Weight[node];
      speed[node] = weight > 0.f ? rate * (samples.Sum[node] / weight) : 0.f;
    });
  buffers.Known[i] = known;
}

/** Speed at the nodes with points of their own. */
void TakeOwnPoints(std::size_t i, const Motion& motion, SubstepBuffers& buffers)
{
  const double* value = buffers.Values.data() + buffers.FirstOwnPoint[i];
  float* speed = buffers.Speed.data() + 512 * i;
  const float rate = static_cast<float>(-motion.Attraction);
  buffers.OwnPoint[i].ForEach(
    [&](int node)
    {
      const float sample = static_cast<float>(*value++);
      speed[node] = std::isfinite(sample) ? rate * sample : 0.f;
    });
}

float LargestOf(const float* speed, const LeafMask& nodes)
{
  float largest = 0.f;
  nodes.ForEach([&](int node) { largest = std::max(largest, std::fabs(speed[node])); });
  return largest;
}

/** All that the samples themselves say; the largest speeds of each leaf with it. */
void TakeTarget(
  const LeafTable& table, std::size_t i, const Motion& motion, SubstepBuffers& buffers)
{
  float* speed = buffers.Speed.data() + 512 * i;
  std::fill_n(speed, 512, 0.f); // what the extension does not reach stands still
  buffers.Known[i] = LeafMask();
  if (SamplesCrossings(motion))
  {
    TakeSamples(table, i, motion, buffers);
  }
  TakeOwnPoints(i, motion, buffers);
  buffers.LargestSpeed[i] = LargestOf(speed, buffers.Known[i] | buffers.OwnPoint[i]);
}

/** A leaf and its neighbours across the faces, as one round of the extension sees them. */
struct Surroundings
{
  const float* Value[3][3]; //< by axis; before, itself, after
  const float* Speed[3][3];
  const LeafMask* Known[3][3];

  Surroundings(const LeafTable& table, std::size_t i, const SubstepBuffers& buffers)
  {
    static const LeafMask nothing;
    for (int n = 0; n < 9; ++n)
    {
      const int axis = n / 3, side = n % 3;
      const std::int32_t leaf =
        side == 1 ? static_cast<std::int32_t>(i) : table[i].Neighbour[FaceNumber(axis, side - 1)];
      this->Value[axis][side] = leaf >= 0 ? table[leaf].Value : nullptr;
      this->Speed[axis][side] =
        leaf >= 0 ? buffers.Speed.data() + 512 * std::size_t(leaf) : nullptr;
      this->Known[axis][side] = leaf >= 0 ? &buffers.Known[leaf] : &nothing;
    }
  }

  /** Nodes whose neighbour in this direction is known. */
  LeafMask KnownAlong(int axis, int sign) const
  {
    const LeafMask& known = *this->Known[axis][1];
    return sign < 0 ? SeenBehind(known, *this->Known[axis][0], axis, 1)
                    : SeenAhead(known, *this->Known[axis][2], axis, 1);
  }
};

/** Sums over the known neighbours of a node. */
struct KnownSpeeds
{
  float Weight;
  float Weighted;
  float Plain;
  float Count;

  float Mean() const
  {
    return this->Weight > 0.f ? this->Weighted / this->Weight : this->Plain / this->Count;
  }
};

/** Adds the neighbour in one direction of those nodes where it is known. */
template <int Axis, int Sign>
void AddNeighbours(const Surroundings& around, const LeafMask& nodes, KnownSpeeds* sums)
{
  constexpr int stride = Stride(Axis);
  const float* own = around.Value[Axis][1];
  nodes.ForEach(
    [&](int node)
    {
      const int side = (((node / stride) & 7) + Sign) >> 3;
      const int next = node + (Sign - 8 * side) * stride;
      const float speed = around.Speed[Axis][side + 1][next];
      const float nearer = std::fabs(own[node]) - std::fabs(around.Value[Axis][side + 1][next]);
      const float weight = std::max(nearer, 0.f);
      KnownSpeeds& sum = sums[node];
      sum.Weight += weight;
      sum.Weighted += weight * speed;
      sum.Plain += speed;
      sum.Count += 1.f;
    });
}

/** Speeds of those of the missing nodes that have a known neighbour; returns which. */
LeafMask ExtendLeaf(const Surroundings& around, const LeafMask& missing, float* speed)
{
  std::array<LeafMask, 6> reached;
  LeafMask front;
  for (int face = 0; face < 6; ++face)
  {
    reached[face] = missing & around.KnownAlong(face / 2, face % 2 ? 1 : -1);
    front = front | reached[face];
  }
  if (front.Any())
  {
    KnownSpeeds sums[512];
    front.ForEach([&](int node) { sums[node] = { 0.f, 0.f, 0.f, 0.f }; });
    AddNeighbours<0, -1>(around, reached[0], sums);
    AddNeighbours<0, 1>(around, reached[1], sums);
    AddNeighbours<1, -1>(around, reached[2], sums);
    AddNeighbours<1, 1>(around, reached[3], sums);
    AddNeighbours<2, -1>(around, reached[4], sums);
    AddNeighbours<2, 1>(around, reached[5], sums);
    front.ForEach([&](int node) { speed[node] = sums[node].Mean(); });
  }
  return front;
}

/** One round; false when no active node is left to reach. */
bool ExtendOnce(const LeafTable& table, SubstepBuffers& buffers)
{
  std::atomic<bool> reached{ false }, left{ false };
  table.ForEach(
    [&](std::size_t i)
    {
      const BandLeaf& leaf = table[i];
      const LeafMask& known = buffers.Known[i];
      buffers.NextKnown[i] = known;
      const LeafMask missing = leaf.Active.Without(known);
      if (!missing.Any())
      {
        return;
      }
      const LeafMask front =
        ExtendLeaf(Surroundings(table, i, buffers), missing, buffers.Speed.data() + 512 * i);
      buffers.NextKnown[i] = known | front;
      if (front.Any())
      {
        reached.store(true, std::memory_order_relaxed);
      }
      if (missing.Without(front).Any())
      {
        left.store(true, std::memory_order_relaxed);
      }
    });
  std::swap(buffers.Known, buffers.NextKnown);
  return reached.load() && left.load();
}

}

double FindTargetSpeed(const LeafTable& table, const Motion& motion, SubstepBuffers& buffers)
{
  const std::size_t size = table.Size();
  buffers.Speed.resize(512 * size);
  buffers.Known.resize(size);
  buffers.NextKnown.resize(size);
  buffers.LargestSpeed.resize(size);
  table.ForEach([&](std::size_t i) { TakeTarget(table, i, motion, buffers); });
  // What is extended is a mean of what is known: no larger.
  while (SamplesCrossings(motion) && !motion.Paper && ExtendOnce(table, buffers))
  {
  }
  double largest = 0.0;
  for (float speed : buffers.LargestSpeed)
  {
    largest = std::max(largest, static_cast<double>(speed));
  }
  return largest;
}

double LargestSpeedAtSurface(const LeafTable& table, const SubstepBuffers& buffers)
{
  const auto speedAt = [&](const LeafTable::Place& place)
  { return buffers.Speed[512 * std::size_t(place.Leaf) + place.Node]; };
  float largest = 0.f;
  for (std::size_t i = 0; i < table.Size(); ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      table[i].Edge[axis].ForEach(
        [&](int node)
        {
          const LeafTable::Place lower{ static_cast<std::int32_t>(i), node };
          const LeafTable::Place upper = table.Step(lower.Leaf, node, axis, 1);
          const float low = table[i].Value[node], high = table[upper.Leaf].Value[upper.Node];
          const float t = low / (low - high);
          largest = std::max(largest, std::fabs((1.f - t) * speedAt(lower) + t * speedAt(upper)));
        });
    }
  }
  return largest;
}

}
