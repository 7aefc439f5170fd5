#include "GhostFill.h"

#include "LeafKernels.h"
#include "LeafLine.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace activesurface
{

namespace
{

/** Sums over the candidates for a node's value. */
struct Candidates
{
  float Sum;
  float Weight;

  void Add(float value, float weight)
  {
    this->Sum += weight * value;
    this->Weight += weight;
  }
};

/** All that is found for a node. */
struct NodeSums
{
  Candidates ThreePoint;
  Candidates Other;
  float LargestStep;
  float Smallest;

  static NodeSums Nothing()
  {
    return { { 0.f, 0.f }, { 0.f, 0.f }, 0.f, std::numeric_limits<float>::max() };
  }
};

/** The extrapolated |u| of the nodes of one layer in one leaf. */
class LayerFill
{
public:
  ACTIVE_ALWAYS_INLINE LayerFill(const LeafTable& table, std::size_t leaf, int layer)
    : Table(table)
    , Leaf(static_cast<std::int32_t>(leaf))
    , Inner(layer - 1)
  {
  }

  /** Calls function(node, magnitude) for each of the nodes. */
  template <class Function>
  ACTIVE_ALWAYS_INLINE void ForEach(const LeafMask& nodes, Function&& function)
  {
    nodes.ForEach([this](int node) { this->Sums[node] = NodeSums::Nothing(); });
    this->AddRays<0, -1>(nodes);
    this->AddRays<0, 1>(nodes);
    this->AddRays<1, -1>(nodes);
    this->AddRays<1, 1>(nodes);
    this->AddRays<2, -1>(nodes);
    this->AddRays<2, 1>(nodes);
    nodes.ForEach([this, &function](int node) { function(node, this->FindMagnitude(node)); });
  }

private:
  /** Rays are as long as the nodes of smaller layers go, up to three. */
  template <int Axis, int Sign>
  ACTIVE_ALWAYS_INLINE void AddRays(const LeafMask& nodes)
  {
    const LeafLine<Axis> line(
      this->Table, this->Leaf, [this](std::int32_t n) { return this->Table[n].Value; });
    const LeafMask& inner = this->Table[this->Leaf].Upto[this->Inner];
    const LeafMask& next =
      this->Table.UptoOf(this->Table[this->Leaf].Neighbour[FaceNumber(Axis, Sign)], this->Inner);
    const LeafMask first = nodes & Seen<Axis, Sign>(inner, next);
    const LeafMask second = first & Seen<Axis, 2 * Sign>(inner, next);
    const LeafMask third = second & Seen<Axis, 3 * Sign>(inner, next);
    first.Without(second).ForEach(
      [&](int node)
      {
        NodeSums& sums = this->Sums[node];
        sums.Smallest = std::min(sums.Smallest, std::fabs(line.At(node, Sign)));
      });
    second.Without(third).ForEach(
      [&](int node)
      {
        AddTwoPoint(
          std::fabs(line.At(node, Sign)), std::fabs(line.At(node, 2 * Sign)), this->Sums[node]);
      });
    third.ForEach(
      [&](int node)
      {
        AddThreePoint(std::fabs(line.At(node, Sign)), std::fabs(line.At(node, 2 * Sign)),
          std::fabs(line.At(node, 3 * Sign)), this->Sums[node]);
      });
  }

  // A step that is no increase has weight 0.
  static ACTIVE_ALWAYS_INLINE void AddTwoPoint(float first, float second, NodeSums& sums)
  {
    const float step = std::max(first - second, 0.f);
    sums.Smallest = std::min(sums.Smallest, first);
    sums.LargestStep = std::max(sums.LargestStep, step);
    sums.Other.Add(first + step, step * step);
  }

  static ACTIVE_ALWAYS_INLINE void AddThreePoint(
    float first, float second, float third, NodeSums& sums)
  {
    const float step = std::max(first - second, 0.f), most = 2.f * step;
    sums.Smallest = std::min(sums.Smallest, first);
    sums.LargestStep = std::max(sums.LargestStep, step);
    const float growth = std::min(std::max(most - (second - third), 0.f), most);
    sums.ThreePoint.Add(first + growth, growth * growth);
  }

  float FindMagnitude(int node)
  {
    NodeSums& sums = this->Sums[node];
    const float least = .01f * sums.LargestStep * sums.LargestStep;
    if (sums.ThreePoint.Weight > 0.f && sums.ThreePoint.Weight >= least)
    {
      return sums.ThreePoint.Sum / sums.ThreePoint.Weight;
    }
    this->AddCorners(node, sums);
    const float weight = sums.ThreePoint.Weight + sums.Other.Weight;
    // No inner increase: a medial axis, where the potential is flat.
    return weight > 0.f ? (sums.ThreePoint.Sum + sums.Other.Sum) / weight : sums.Smallest;
  }

  /** Around the corners of a square: p + q - r, from two neighbours and the node between them. */
  void AddCorners(int node, NodeSums& sums) const
  {
    for (int first = 0; first < 2; ++first)
    {
      for (int second = first + 1; second < 3; ++second)
      {
        for (int signs = 0; signs < 4; ++signs)
        {
          int alongFirst[3] = { 0, 0, 0 }, alongSecond[3] = { 0, 0, 0 }, between[3] = { 0, 0, 0 };
          alongFirst[first] = between[first] = signs & 1 ? 1 : -1;
          alongSecond[second] = between[second] = signs & 2 ? 1 : -1;
          AddCorner(this->AtOffset(node, alongFirst), this->AtOffset(node, alongSecond),
            this->AtOffset(node, between), sums);
        }
      }
    }
  }

  /** |u| of a node of a smaller layer, else a negative number. */
  float AtOffset(int node, const int offset[3]) const
  {
    const LeafTable::Place place =
      this->Table.Offset(this->Leaf, node, offset[0], offset[1], offset[2]);
    const bool isInner =
      place.Leaf >= 0 && this->Table[place.Leaf].Upto[this->Inner].Has(place.Node);
    return isInner ? std::fabs(this->Table[place.Leaf].Value[place.Node]) : -1.f;
  }

  static void AddCorner(float p, float q, float r, NodeSums& sums)
  {
    const float growthFirst = q - r, growthSecond = p - r;
    if (p >= 0.f && q >= 0.f && r >= 0.f && growthFirst > 0.f && growthSecond > 0.f &&
      p + growthFirst >= sums.Smallest)
    {
      sums.Other.Add(p + growthFirst, growthFirst * growthFirst + growthSecond * growthSecond);
    }
  }

  const LeafTable& Table;
  const std::int32_t Leaf;
  const int Inner;    //< last layer whose values may be used
  NodeSums Sums[512]; //< of the layer's nodes, all else is not set
};

/** Nodes of a layer whose value is not the last substep's: ghosts, and those that entered. */
ACTIVE_ALWAYS_INLINE LeafMask NodesToFill(const BandLeaf& leaf, int layer)
{
  return leaf.Upto[layer].Without(leaf.Upto[layer - 1]).Without(leaf.Active & leaf.Advanced);
}
struct FillLayer
{
  LeafTable& Table;
  int Layer;

  ACTIVE_ALWAYS_INLINE void operator()(std::size_t i) const
  {
    BandLeaf& leaf = this->Table[i];
    const LeafMask nodes = NodesToFill(leaf, this->Layer);
    if (!nodes.Any())
    {
      return;
    }
    LayerFill(this->Table, i, this->Layer)
      .ForEach(nodes,
        [&leaf](int node, float magnitude)
        { leaf.Value[node] = leaf.Inside.Has(node) ? -magnitude : magnitude; });
  }
};

}

void FillGhosts(LeafTable& table)
{
  for (int layer = 1; layer < NumberOfLayers; ++layer)
  {
    ForEachLeaf(table, FillLayer{ table, layer });
  }
}

}
