/**
 * Gradients of a field at the points of a leaf at which the target is evaluated: central
 * differences at the two nodes of a crossed edge, interpolated to the crossing; at a node with a
 * point of its own those of the node. The potential's point along the outward normal.
 */
#ifndef SampleGradients_h
#define SampleGradients_h

#include "Leaves/LeafBlock.h"
#include "Leaves/LeafLine.h"
#include "Substep/NodePoints.h"

#include <cmath>
#include <cstddef>

namespace activesurface
{

class SampleGradients
{
public:
  static constexpr int Most = 4 * 512; //< three edges a node, and the node itself

  /** In the order of the points. arrayOf(leaf): the field's 512 numbers of a leaf. */
  template <class ArrayOf>
  ACTIVE_ALWAYS_INLINE SampleGradients(
    const LeafTable& table, std::size_t i, const Motion& motion, const ArrayOf& arrayOf)
  {
    LeafBlock block;
    block.Gather(table, table[i], arrayOf);
    std::size_t count = 0;
    if (SamplesCrossings(motion))
    {
      this->AddCrossings<0, LeafBlock::X>(table, i, block, count);
      this->AddCrossings<1, LeafBlock::Y>(table, i, block, count);
      this->AddCrossings<2, LeafBlock::Z>(table, i, block, count);
    }
    if (HasNodePoints(motion))
    {
      NodesWithOwnPoint(table, table[i], motion)
        .ForEach([&](int node) ACTIVE_INLINED { this->Set(count++, Place(block, node), 0, 0.f); });
    }
  }

  /** Product with a vector [per voxel]. */
  template <class Real>
  ACTIVE_ALWAYS_INLINE Real Dot(std::size_t point, const Real* vector) const
  {
    return this->X[point] * vector[0] + this->Y[point] * vector[1] + this->Z[point] * vector[2];
  }

  /** The unit vector along the gradient; 0 where that vanishes but for rounding. */
  ACTIVE_ALWAYS_INLINE void GetDirection(std::size_t point, double* direction) const
  {
    constexpr double none = 1e-12;
    const double x = this->X[point], y = this->Y[point], z = this->Z[point];
    const double square = x * x + y * y + z * z;
    const double factor = square > none ? 1.0 / std::sqrt(square) : 0.0;
    direction[0] = factor * x;
    direction[1] = factor * y;
    direction[2] = factor * z;
  }

private:
  static ACTIVE_ALWAYS_INLINE const float* Place(const LeafBlock& block, int node)
  {
    return block.Row(node >> 6, (node >> 3) & 7) + (node & 7);
  }

  /** Between two nodes of the block, at a share t of the way. */
  ACTIVE_ALWAYS_INLINE void Set(std::size_t point, const float* low, int step, float t)
  {
    const auto at = [low, step, t](int stride) ACTIVE_INLINED
    {
      const float atLow = low[stride] - low[-stride];
      const float atHigh = low[step + stride] - low[step - stride];
      return .5f * ((1.f - t) * atLow + t * atHigh);
    };
    this->X[point] = at(LeafBlock::X);
    this->Y[point] = at(LeafBlock::Y);
    this->Z[point] = at(LeafBlock::Z);
  }

  template <int Axis, int Step>
  ACTIVE_ALWAYS_INLINE void AddCrossings(
    const LeafTable& table, std::size_t i, const LeafBlock& block, std::size_t& count)
  {
    const BandLeaf& leaf = table[i];
    const LeafLine<Axis> values(
      table, static_cast<std::int32_t>(i), [&table](std::int32_t n) { return table[n].Value; });
    leaf.Edge[Axis].ForEach(
      [&](int node) ACTIVE_INLINED
      {
        const float low = leaf.Value[node], high = values.At(node, 1);
        this->Set(count++, Place(block, node), Step, low / (low - high));
      });
  }

  float X[Most];
  float Y[Most];
  float Z[Most];
};

}

#endif
