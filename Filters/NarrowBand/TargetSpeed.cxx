#include "TargetSpeed.h"

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

  /** own: potential at the node, other: across the crossed edge. */
  void Add(int node, float own, float other, double value)
  {
    constexpr float smallest = 1e-6f; // below, the crossing counts as on the node
    const float sample = static_cast<float>(value);
    if (!std::isfinite(sample))
    {
      return;
    }
    const float t = std::max(own / (own - other), smallest);
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
void TakeSamples(const LeafTable& table, std::size_t i, double attraction, SubstepBuffers& buffers)
{
  const BandLeaf& leaf = table[i];
  WeightedSamples samples;
  LeafMask known;
  for (int axis = 0; axis < 3; ++axis)
  {
    AddIncomingEdges(table, leaf, axis, buffers.Values.data(), samples, known);
    AddOwnEdges(table, leaf, axis, buffers.Values.data(), samples, known);
  }
  float* speed = buffers.Speed.data() + 512 * i;
  std::fill_n(speed, 512, 0.f); // what the extension does not reach stands still
  float largest = 0.f;
  const float rate = static_cast<float>(-attraction);
  known.ForEach(
    [&](int node)
    {
      const float weight = samples.Weight[node];
      speed[node] = weight > 0.f ? rate * (samples.Sum[node] / weight) : 0.f;
      largest = std::max(largest, std::fabs(speed[node]));
    });
  buffers.Known[i] = known;
  buffers.LargestSpeed[i] = largest;
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

  LeafMask NextToKnown() const
  {
    LeafMask next;
    for (int axis = 0; axis < 3; ++axis)
    {
      const LeafMask& known = *this->Known[axis][1];
      next = next | SeenBehind(known, *this->Known[axis][0], axis, 1) |
        SeenAhead(known, *this->Known[axis][2], axis, 1);
    }
    return next;
  }
};

/** Sums over the known neighbours of a node. Others are not read: their leaf may be writing them.
 */
struct KnownSpeeds
{
  const Surroundings& Around;
  const int Node;
  const float Own; //< |u| of the node
  float Weights = 0.f;
  float Weighted = 0.f;
  float Plain = 0.f;
  float Count = 0.f;

  template <int Axis>
  void Add(int sign)
  {
    constexpr int stride = Stride(Axis);
    const int side = (((this->Node / stride) & 7) + sign) >> 3;
    const int next = this->Node + (sign - 8 * side) * stride;
    if (!this->Around.Known[Axis][side + 1]->Has(next))
    {
      return;
    }
    const float speed = this->Around.Speed[Axis][side + 1][next];
    const float nearer = this->Own - std::fabs(this->Around.Value[Axis][side + 1][next]);
    const float weight = std::max(nearer, 0.f);
    this->Weights += weight;
    this->Weighted += weight * speed;
    this->Plain += speed;
    this->Count += 1.f;
  }
};

float ExtendedSpeed(const Surroundings& around, int node)
{
  KnownSpeeds sums{ around, node, std::fabs(around.Value[0][1][node]) };
  sums.Add<0>(-1);
  sums.Add<0>(1);
  sums.Add<1>(-1);
  sums.Add<1>(1);
  sums.Add<2>(-1);
  sums.Add<2>(1);
  return sums.Weights > 0.f ? sums.Weighted / sums.Weights : sums.Plain / sums.Count;
}

/** One round; false when no active node was left to reach. */
bool ExtendOnce(const LeafTable& table, SubstepBuffers& buffers)
{
  std::atomic<bool> reached{ false };
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
      const Surroundings around(table, i, buffers);
      const LeafMask front = missing & around.NextToKnown();
      if (!front.Any())
      {
        return;
      }
      float* speed = buffers.Speed.data() + 512 * i;
      front.ForEach([&](int node) { speed[node] = ExtendedSpeed(around, node); });
      buffers.NextKnown[i] = known | front;
      reached.store(true, std::memory_order_relaxed);
    });
  std::swap(buffers.Known, buffers.NextKnown);
  return reached.load();
}

}

double FindTargetSpeed(const LeafTable& table, double attraction, SubstepBuffers& buffers)
{
  const std::size_t size = table.Size();
  buffers.Speed.resize(512 * size);
  buffers.Known.resize(size);
  buffers.NextKnown.resize(size);
  buffers.LargestSpeed.resize(size);
  table.ForEach([&](std::size_t i) { TakeSamples(table, i, attraction, buffers); });
  while (ExtendOnce(table, buffers))
  {
  }
  double largest = 0.0;
  for (float speed : buffers.LargestSpeed)
  {
    largest = std::max(largest, static_cast<double>(speed));
  }
  return largest;
}

}
