/**
 * Means of the target's values on the crossed edges around each node of a leaf (section 4.3 of the
 * paper, see NarrowBand.h).
 *
 * The weight of a sample is 1/t^2, where t is the fraction of the edge from the node to the
 * crossing. If the values are linear in space, and the surface is a plane that crosses an edge of
 * the node on each axis, the mean is the value at the point of the plane closest to the node.
 */
#ifndef WeightedSamples_h
#define WeightedSamples_h

#include "Front/SubstepBuffers.h"
#include "Leaves/LeafLine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace activesurface
{

class WeightedSamples
{
public:
  /** isPlain: all weights are 1, as in the paper's scheme. */
  ACTIVE_ALWAYS_INLINE explicit WeightedSamples(bool isPlain)
    : IsPlain(isPlain)
  {
  }

  /** Adds the samples of a leaf that has been sampled, and of the sampled leaves before the leaf
   * along the axes. */
  ACTIVE_ALWAYS_INLINE void Add(
    const LeafTable& table, std::size_t i, const SubstepBuffers& buffers)
  {
    this->AddEdges<0>(table, i, buffers);
    this->AddEdges<1>(table, i, buffers);
    this->AddEdges<2>(table, i, buffers);
  }

  /** Returns rate times the mean; 0 if all samples were dropped. */
  ACTIVE_ALWAYS_INLINE float GetSpeed(int node, float rate) const
  {
    return this->Weight[node] > 0.f ? rate * (this->Sum[node] / this->Weight[node]) : 0.f;
  }

private:
  static constexpr int MaximumEdges = 512 + 64; // along an axis; 64 begin in the previous leaf
  static constexpr int Elsewhere = 512;         // stands for a node of another leaf

  /** Edges as arrays: values at the ends, and the sample that both ends get. */
  struct Edges
  {
    int Count = 0;
    float Low[MaximumEdges], High[MaximumEdges], Sample[MaximumEdges];
    short LowNode[MaximumEdges], HighNode[MaximumEdges];

    ACTIVE_ALWAYS_INLINE void Add(float low, float high, float sample, int lowNode, int highNode)
    {
      this->Low[this->Count] = low;
      this->High[this->Count] = high;
      this->Sample[this->Count] = sample;
      this->LowNode[this->Count] = static_cast<short>(lowNode);
      this->HighNode[this->Count] = static_cast<short>(highNode);
      ++this->Count;
    }
  };

  /** Returns a leaf's samples, beginning at the first crossing along an axis. */
  template <int Axis>
  static ACTIVE_ALWAYS_INLINE const float* FirstOf(
    const BandLeaf& leaf, std::size_t i, const SubstepBuffers& buffers)
  {
    return buffers.Samples.data() + buffers.FirstSample[i] + leaf.CrossingsBefore[Axis];
  }

  /** Finds the edges that begin in the previous leaf and end on the first plane of `leaf`. */
  template <int Axis>
  static ACTIVE_ALWAYS_INLINE void FindIncoming(
    const LeafTable& table, const BandLeaf& leaf, const SubstepBuffers& buffers, Edges& edges)
  {
    const std::int32_t number = leaf.Neighbour[FaceNumber(Axis, -1)];
    if (number < 0 || buffers.FirstSample[number] == SubstepBuffers::NoSamples)
    {
      return;
    }
    const BandLeaf& before = table[number];
    const float* samples = FirstOf<Axis>(before, number, buffers);
    std::size_t earlier = 0;
    for (int x = 0; x < 8; ++x)
    {
      const std::uint64_t word = before.Edge[Axis].Word[x];
      const std::uint64_t last = Axis == 0 ? (x == 7 ? ~0ull : 0ull)
        : Axis == 1                        ? 0xffull << 56
                                           : 0x8080808080808080ull;
      for (std::uint64_t left = word & last; left != 0; left &= left - 1)
      {
        const int bit = LowestBit(left);
        const int lower = 64 * x + bit, node = lower - 7 * Stride(Axis);
        edges.Add(before.Value[lower], leaf.Value[node],
          samples[earlier + CountBits(word & ((std::uint64_t(1) << bit) - 1))], Elsewhere, node);
      }
      earlier += CountBits(word);
    }
  }

  template <int Axis>
  static ACTIVE_ALWAYS_INLINE void FindOwn(
    const LeafTable& table, std::size_t i, const SubstepBuffers& buffers, Edges& edges)
  {
    const BandLeaf& leaf = table[i];
    const LeafLine<Axis> line(
      table, static_cast<std::int32_t>(i), [&](std::int32_t n) { return table[n].Value; });
    const float* samples = FirstOf<Axis>(leaf, i, buffers);
    std::size_t sample = 0;
    leaf.Edge[Axis].ForEach(
      [&](int node) ACTIVE_INLINED
      {
        const bool isWithin = ((node / Stride(Axis)) & 7) < 7;
        edges.Add(leaf.Value[node], line.At(node, 1), samples[sample++], node,
          isWithin ? node + Stride(Axis) : Elsewhere);
      });
  }

  /** Adds the edges along an axis: for each node, first the edge behind, then the edge ahead. */
  template <int Axis>
  ACTIVE_ALWAYS_INLINE void AddEdges(
    const LeafTable& table, std::size_t i, const SubstepBuffers& buffers)
  {
    Edges edges;
    FindIncoming<Axis>(table, table[i], buffers, edges);
    FindOwn<Axis>(table, i, buffers, edges);
    float lowWeight[MaximumEdges], highWeight[MaximumEdges];
    for (int e = 0; e < edges.Count; ++e)
    {
      const float low = edges.Low[e], high = edges.High[e];
      const bool counts = std::fabs(edges.Sample[e]) <= std::numeric_limits<float>::max();
      lowWeight[e] = counts ? this->WeightOf(low / (low - high)) : 0.f;
      highWeight[e] = counts ? this->WeightOf(high / (high - low)) : 0.f;
      edges.Sample[e] = counts ? edges.Sample[e] : 0.f;
    }
    for (int e = 0; e < edges.Count; ++e)
    {
      this->Weight[edges.LowNode[e]] += lowWeight[e];
      this->Weight[edges.HighNode[e]] += highWeight[e];
      this->Sum[edges.LowNode[e]] += lowWeight[e] * edges.Sample[e];
      this->Sum[edges.HighNode[e]] += highWeight[e] * edges.Sample[e];
    }
  }

  ACTIVE_ALWAYS_INLINE float WeightOf(float fraction) const
  {
    constexpr float smallest = 1e-6f; // smaller fractions count as this one
    const float t = this->IsPlain ? 1.f : std::max(fraction, smallest);
    return 1.f / (t * t);
  }

  const bool IsPlain;
  std::array<float, Elsewhere + 1> Weight{};
  std::array<float, Elsewhere + 1> Sum{};
};

}

#endif
