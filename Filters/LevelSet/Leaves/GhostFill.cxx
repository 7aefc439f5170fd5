#include "Leaves/GhostFill.h"

#include "Leaves/LeafKernels.h"
#include "Leaves/LeafLine.h"
#include "Leaves/LeafTable.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace activesurface
{

namespace
{

/** Weighted sums over the candidates for a node's value. */
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

/** Growth g of |u| beyond three nodes in one direction (GhostFill.h). step: increase from the
 * second node to the first; with a step of 0, g is 0. */
ACTIVE_ALWAYS_INLINE float LimitedGrowth(float step, float second, float third)
{
  const float most = 2.f * step;
  return std::min(std::max(most - (second - third), 0.f), most);
}

ACTIVE_ALWAYS_INLINE float Increase(float first, float second)
{
  return std::max(first - second, 0.f);
}

/** Value of a node that must not be used. */
constexpr float Missing = -std::numeric_limits<float>::infinity();

/** Extrapolates |u| to the nodes of one layer in one leaf, from smaller layers; see GhostFill.h. */
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
    nodes.ForEach([this](int node) ACTIVE_INLINED
      { this->Weight[node] = this->Sum[node] = this->LargestStep[node] = 0.f; });
    this->AddRays<0, -1>(nodes);
    this->AddRays<0, 1>(nodes);
    this->AddRays<1, -1>(nodes);
    this->AddRays<1, 1>(nodes);
    this->AddRays<2, -1>(nodes);
    this->AddRays<2, 1>(nodes);
    nodes.ForEach(
      [this, &function](int node) ACTIVE_INLINED
      {
        const float weight = this->Weight[node];
        const float least = .01f * this->LargestStep[node] * this->LargestStep[node];
        const bool isCertain = weight > 0.f && weight >= least;
        function(node, isCertain ? this->Sum[node] / weight : this->FindUncertain(node));
      });
  }

private:
  /** Adds rays whose three nodes are all in smaller layers. Of a ray with only two such nodes, the
   * step counts for LargestStep, no more. */
  template <int Axis, int Sign>
  ACTIVE_ALWAYS_INLINE void AddRays(const LeafMask& nodes)
  {
    const LeafLine<Axis> line(
      this->Table, this->Leaf, [this](std::int32_t n) { return this->Table[n].Value; });
    const LeafMask& inner = this->Table[this->Leaf].UpToLayer[this->Inner];
    const LeafMask& next = this->Table.UpToLayerOf(
      this->Table[this->Leaf].Neighbour[FaceNumber(Axis, Sign)], this->Inner);
    const LeafMask first = nodes & Seen<Axis, Sign>(inner, next);
    const LeafMask second = first & Seen<Axis, 2 * Sign>(inner, next);
    const LeafMask third = second & Seen<Axis, 3 * Sign>(inner, next);
    second.Without(third).ForEach(
      [&](int node) ACTIVE_INLINED
      {
        const float step =
          Increase(std::fabs(line.At(node, Sign)), std::fabs(line.At(node, 2 * Sign)));
        this->LargestStep[node] = std::max(this->LargestStep[node], step);
      });
    third.ForEach(
      [&](int node) ACTIVE_INLINED
      {
        const float a1 = std::fabs(line.At(node, Sign)), a2 = std::fabs(line.At(node, 2 * Sign));
        const float a3 = std::fabs(line.At(node, 3 * Sign));
        const float step = Increase(a1, a2), growth = LimitedGrowth(step, a2, a3);
        this->LargestStep[node] = std::max(this->LargestStep[node], step);
        this->Sum[node] += growth * growth * (a1 + growth);
        this->Weight[node] += growth * growth;
      });
  }

  /** Returns the weighted mean over all candidates; without weights, the smallest |u| of a
   * neighbour. For nodes whose three-point rays have too little weight.
   */
  float FindUncertain(int node) const
  {
    Candidates other = { 0.f, 0.f };
    float smallest = std::numeric_limits<float>::max();
    for (int face = 0; face < 6; ++face)
    {
      float ray[3];
      for (int steps = 1; steps <= 3; ++steps)
      {
        const bool goesOn = steps == 1 || ray[steps - 2] > Missing;
        ray[steps - 1] =
          goesOn ? this->AtSteps(node, face / 2, face % 2 ? steps : -steps) : Missing;
      }
      smallest = ray[0] > Missing ? std::min(smallest, ray[0]) : smallest;
      if (ray[1] > Missing && !(ray[2] > Missing))
      {
        const float step = Increase(ray[0], ray[1]);
        other.Add(ray[0] + step, step * step);
      }
    }
    this->AddCorners(node, smallest, other);
    const float weight = this->Weight[node] + other.Weight;
    // Without weight no candidate has an increase: on a medial axis the potential is flat.
    return weight > 0.f ? (this->Sum[node] + other.Sum) / weight : smallest;
  }

  /** Adds candidates p + q - r: p and q are |u| at two neighbours of the node, r is |u| at the
   * fourth corner of their square. */
  void AddCorners(int node, float smallest, Candidates& other) const
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
            this->AtOffset(node, between), smallest, other);
        }
      }
    }
  }

  ///@{
  /** Returns |u| of a node of a smaller layer, otherwise Missing. */
  float At(const LeafTable::Place& place) const
  {
    const bool isInner =
      place.Leaf >= 0 && this->Table[place.Leaf].UpToLayer[this->Inner].Has(place.Node);
    return isInner ? std::fabs(this->Table[place.Leaf].Value[place.Node]) : Missing;
  }
  float AtOffset(int node, const int offset[3]) const
  {
    return this->At(this->Table.Offset(this->Leaf, node, offset[0], offset[1], offset[2]));
  }
  float AtSteps(int node, int axis, int steps) const
  {
    return this->At(this->Table.Step(this->Leaf, node, axis, steps));
  }
  ///@}

  static void AddCorner(float p, float q, float r, float smallest, Candidates& other)
  {
    const float growthFirst = q - r, growthSecond = p - r;
    if (p > Missing && q > Missing && r > Missing && growthFirst > 0.f && growthSecond > 0.f &&
      p + growthFirst >= smallest)
    {
      other.Add(p + growthFirst, growthFirst * growthFirst + growthSecond * growthSecond);
    }
  }

  const LeafTable& Table;
  const std::int32_t Leaf;
  const int Inner; //< last layer whose values may be used
  // Set only for the layer's nodes. Sum and Weight contain only three-point rays.
  float Sum[512];
  float Weight[512];
  float LargestStep[512];
};

/** Nodes of a layer that the last substep has not updated: ghosts, and nodes that entered the band.
 * Only affected leaves can contain nodes that entered the band. */
ACTIVE_ALWAYS_INLINE LeafMask NodesToFill(const BandLeaf& leaf, bool isAffected, int layer)
{
  const LeafMask valid = isAffected ? leaf.Active & leaf.Updated : leaf.Active;
  return leaf.UpToLayer[layer].Without(leaf.UpToLayer[layer - 1]).Without(valid);
}

ACTIVE_ALWAYS_INLINE void SetMagnitude(BandLeaf& leaf, int node, float magnitude)
{
  leaf.Value[node] = leaf.Inside.Has(node) ? -magnitude : magnitude;
}

struct FillLayer
{
  LeafTable& Table;
  int Layer;
  bool IsAffected; //< true if the leaves are affected

  ACTIVE_ALWAYS_INLINE void operator()(std::size_t i) const
  {
    BandLeaf& leaf = this->Table[i];
    const LeafMask nodes = NodesToFill(leaf, this->IsAffected, this->Layer);
    if (!nodes.Any())
    {
      return;
    }
    LayerFill(this->Table, i, this->Layer)
      .ForEach(nodes,
        [&leaf](int node, float magnitude) ACTIVE_INLINED { SetMagnitude(leaf, node, magnitude); });
  }
};

LeafList Without(const LeafList& leaves, const LeafList& others)
{
  LeafList rest;
  std::set_difference(
    leaves.begin(), leaves.end(), others.begin(), others.end(), std::back_inserter(rest));
  return rest;
}

// Fills ghosts of layer 4 in leaves next to the affected leaves. Three-point rays over three layers
// reach ghosts up to nine nodes from an updated node, beyond the affected leaves.
void FillBesideAffected(LeafTable& table, const ActiveSet& set)
{
  const LeafList beyond = Without(table.FindAround(set.Affected), set.Affected);
  ForEachLeaf(table, beyond, FillLayer{ table, LastLayer, false });
}

}

void FillGhosts(LeafTable& table, const ActiveSet& set)
{
  for (int layer = 1; layer <= LastLayer; ++layer)
  {
    ForEachLeaf(table, set.Affected, FillLayer{ table, layer, true });
  }
  FillBesideAffected(table, set);
}

}
