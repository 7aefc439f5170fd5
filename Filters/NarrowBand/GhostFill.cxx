#include "GhostFill.h"

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
  float Sum = 0.f;
  float Weight = 0.f;

  void Add(float value, float weight)
  {
    this->Sum += weight * value;
    this->Weight += weight;
  }
};

/** The extrapolated |u| of one node of a layer. */
class NodeFill
{
public:
  NodeFill(const LeafTable& table, const LeafCross& cross, std::int32_t leaf, int layer)
    : Table(table)
    , Cross(cross)
    , Leaf(leaf)
    , Inner(layer - 1)
  {
  }

  float Magnitude(int node)
  {
    this->Node = node;
    this->ThreePoint = this->Other = Candidates();
    this->LargestStep = 0.f;
    this->Smallest = std::numeric_limits<float>::max();
    this->AddRay<0>(-1);
    this->AddRay<0>(1);
    this->AddRay<1>(-1);
    this->AddRay<1>(1);
    this->AddRay<2>(-1);
    this->AddRay<2>(1);
    const float least = .01f * this->LargestStep * this->LargestStep;
    if (this->ThreePoint.Weight > 0.f && this->ThreePoint.Weight >= least)
    {
      return this->ThreePoint.Sum / this->ThreePoint.Weight;
    }
    this->AddCorners();
    const float weight = this->ThreePoint.Weight + this->Other.Weight;
    // No inner increase: a medial axis, where the potential is flat.
    return weight > 0.f ? (this->ThreePoint.Sum + this->Other.Sum) / weight : this->Smallest;
  }

private:
  /** |u| of a node of a smaller layer, else a negative number. */
  float Value(const BandLeaf& leaf, int node) const
  {
    return leaf.Upto[this->Inner].Has(node) ? std::fabs(leaf.Value[node]) : -1.f;
  }

  template <int Axis>
  float OnRay(int steps) const
  {
    const auto place = this->Cross.Step<Axis>(this->Node, steps);
    return this->Value(*place.Leaf, place.Node);
  }

  template <int Axis>
  void AddRay(int sign)
  {
    const float first = this->OnRay<Axis>(sign);
    if (first < 0.f)
    {
      return;
    }
    this->Smallest = std::min(this->Smallest, first);
    const float second = this->OnRay<Axis>(2 * sign);
    const float step = first - second;
    if (second < 0.f || step <= 0.f)
    {
      return;
    }
    this->LargestStep = std::max(this->LargestStep, step);
    const float third = this->OnRay<Axis>(3 * sign);
    if (third < 0.f)
    {
      this->Other.Add(first + step, step * step);
      return;
    }
    const float growth = std::min(std::max(2.f * step - (second - third), 0.f), 2.f * step);
    this->ThreePoint.Add(first + growth, growth * growth);
  }

  /** Around the corners of a square: p + q - r, from two neighbours and the node between them. */
  void AddCorners()
  {
    for (int first = 0; first < 2; ++first)
    {
      for (int second = first + 1; second < 3; ++second)
      {
        for (int signs = 0; signs < 4; ++signs)
        {
          this->AddCorner(first, signs & 1 ? 1 : -1, second, signs & 2 ? 1 : -1);
        }
      }
    }
  }

  float AtOffset(const int offset[3]) const
  {
    const LeafTable::Place place =
      this->Table.Offset(this->Leaf, this->Node, offset[0], offset[1], offset[2]);
    return place.Leaf >= 0 ? this->Value(this->Table[place.Leaf], place.Node) : -1.f;
  }

  void AddCorner(int firstAxis, int firstSign, int secondAxis, int secondSign)
  {
    int alongFirst[3] = { 0, 0, 0 }, alongSecond[3] = { 0, 0, 0 }, between[3] = { 0, 0, 0 };
    alongFirst[firstAxis] = between[firstAxis] = firstSign;
    alongSecond[secondAxis] = between[secondAxis] = secondSign;
    const float p = this->AtOffset(alongFirst);
    const float q = this->AtOffset(alongSecond);
    const float r = this->AtOffset(between);
    if (p < 0.f || q < 0.f || r < 0.f)
    {
      return;
    }
    const float growthFirst = q - r, growthSecond = p - r;
    if (growthFirst > 0.f && growthSecond > 0.f && p + growthFirst >= this->Smallest)
    {
      this->Other.Add(p + growthFirst, growthFirst * growthFirst + growthSecond * growthSecond);
    }
  }

  const LeafTable& Table;
  const LeafCross& Cross;
  const std::int32_t Leaf;
  const int Inner; //< last layer whose values may be used
  int Node = 0;
  Candidates ThreePoint;
  Candidates Other;
  float LargestStep = 0.f;
  float Smallest = 0.f;
};

/** Nodes of a layer whose value is not the last substep's: ghosts, and those that entered. */
LeafMask NodesToFill(const BandLeaf& leaf, int layer)
{
  return leaf.Upto[layer].Without(leaf.Upto[layer - 1]).Without(leaf.Active & leaf.Advanced);
}

}

void FillGhosts(LeafTable& table)
{
  for (int layer = 1; layer < NumberOfLayers; ++layer)
  {
    table.ForEach(
      [&](std::size_t i)
      {
        BandLeaf& leaf = table[i];
        const LeafMask nodes = NodesToFill(leaf, layer);
        if (!nodes.Any())
        {
          return;
        }
        const LeafCross cross = table.Cross(leaf);
        NodeFill fill(table, cross, static_cast<std::int32_t>(i), layer);
        nodes.ForEach(
          [&](int node)
          {
            const float magnitude = fill.Magnitude(node);
            leaf.Value[node] = leaf.Inside.Has(node) ? -magnitude : magnitude;
          });
      });
  }
}

}
