#include "Front/StepForward.h"

#include "Base/Tension.h"
#include "Front/RowKernels.h"
#include "Front/SubstepBuffers.h"
#include "Leaves/LeafKernels.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace activesurface
{

namespace
{

/** Adds all terms to a row. targetSpeeds: null without attraction. */
ACTIVE_ALWAYS_INLINE void AddTerms(const float* u, const float* targetSpeeds, unsigned relaxed,
  const StepCoefficients& coefficients, float* next)
{
  if (coefficients.Moves())
  {
    RowMask relaxation = MaskOfBits(relaxed);
    float speed[8];
    for (int z = 0; z < 8; ++z)
    {
      relaxation[z] *= coefficients.Relaxation;
      speed[z] = (targetSpeeds ? targetSpeeds[z] : 0.f) + coefficients.Uniform;
    }
    if (coefficients.Central)
    {
      AddCentralTransport(u, speed, coefficients.Advection, next);
      AddTransport(u, speed, 0.f, relaxation, next);
    }
    else
    {
      AddTransport(u, speed, coefficients.Advection, relaxation, next);
    }
  }
  if (coefficients.Tension != 0.f)
  {
    AddTension<LeafBlock::X, LeafBlock::Y>(u, coefficients.Tension, next);
  }
}

/**
 * Finds the largest speed of the surface at the nodes of crossed edges. Rows after a row with a
 * speed above Enough are skipped: in most moving leaves, all rows after the first.
 */
struct FindRate
{
  LeafTable& Table;
  const StepCoefficients& Coefficients;
  double Enough;
  const SubstepBuffers& Buffers;

  ACTIVE_ALWAYS_INLINE void operator()(std::size_t i) const
  {
    const BandLeaf& leaf = this->Table[i];
    const LeafMask crossed = NodesWithCrossing(this->Table, leaf);
    int row = 0;
    while (row < 64 && crossed.Row(row / 8, row % 8) == 0)
    {
      ++row;
    }
    float largest = 0.f;
    if (row < 64)
    {
      LeafBlock block;
      block.GatherAround(this->Table, leaf, row / 8, row % 8);
      largest = this->LargestOfRow(block, crossed, i, row);
      if (largest <= this->Enough)
      {
        block.Gather(this->Table, leaf);
      }
      for (++row; row < 64 && largest <= this->Enough; ++row)
      {
        largest = std::max(largest, this->LargestOfRow(block, crossed, i, row));
      }
    }
    this->Table.SummaryOf(i).Speed.AtSurface = largest;
  }

private:
  ACTIVE_ALWAYS_INLINE float LargestOfRow(
    const LeafBlock& block, const LeafMask& crossed, std::size_t i, int row) const
  {
    const unsigned nodes = crossed.Row(row / 8, row % 8);
    float largest = 0.f;
    if (nodes != 0)
    {
      const float* u = block.Row(row / 8, row % 8);
      float rates[8] = {}, squares[8];
      AddTerms(u, this->Buffers.SpeedOf(i) + 8 * row, 0, this->Coefficients, rates);
      CentralGradientSquares(u, squares);
      float speeds[8];
      ACTIVE_LANES
      for (int z = 0; z < 8; ++z)
      {
        speeds[z] = std::fabs(rates[z]) / std::sqrt(squares[z]);
      }
      for (int z = 0; z < 8; ++z)
      {
        largest = std::max(largest, (nodes >> z) & 1u ? speeds[z] : 0.f); // 0 / 0 counts as 0
      }
    }
    return largest;
  }
};

struct StepLeaf
{
  const LeafTable& Table;
  const StepCoefficients& Coefficients;
  SubstepBuffers& Buffers;

  ACTIVE_ALWAYS_INLINE void operator()(std::size_t i) const
  {
    const BandLeaf& leaf = this->Table[i];
    LeafBlock block;
    block.Gather(this->Table, leaf);
    // Relaxing the ends of a crossed edge would move the surface.
    const LeafMask relaxed = this->Coefficients.Relaxation > 0.f
      ? LeafMask::All().Without(NodesWithCrossing(this->Table, leaf))
      : LeafMask();
    const float* speeds = this->Coefficients.HasTargetSpeed ? this->Buffers.SpeedOf(i) : nullptr;
    int flat = 0, steep = 0;
    unsigned unbounded = 0;
    for (int row = 0; row < 64; ++row)
    {
      const int x = row / 8, y = row % 8;
      const unsigned active = leaf.Active.Row(x, y);
      float* result = this->Buffers.NextOf(i) + 8 * row;
      const float* u = block.Row(x, y);
      if (active == 0)
      {
        std::copy_n(u, 8, result);
        continue;
      }
      float next[8];
      std::copy_n(u, 8, next);
      AddTerms(u, speeds ? speeds + 8 * row : nullptr, relaxed.Row(x, y), this->Coefficients, next);
      ReplaceActive(u, next, active, result);
      unbounded |= AnyUnbounded(next, active);
      if (const unsigned zero = leaf.UpToLayer[0].Row(x, y))
      {
        CountGradients(u, zero, flat, steep);
      }
    }
    this->Buffers.FlatNodes[i] = flat;
    this->Buffers.SteepNodes[i] = steep;
    this->Buffers.Unbounded[i] = static_cast<std::uint8_t>(unbounded);
  }
};

}

void FindRates(LeafTable& table, const LeafList& leaves, const StepCoefficients& coefficients,
  double enough, const SubstepBuffers& buffers)
{
  ForEachLeaf(table, leaves, FindRate{ table, coefficients, enough, buffers });
}

GradientCounts StepForward(const LeafTable& table, const ActiveSet& set,
  const StepCoefficients& coefficients, SubstepBuffers& buffers)
{
  const std::size_t size = table.Size();
  buffers.MakeRoomForNodes(size); // already allocated if there are speeds
  buffers.MakeRoomForCounts(size);
  ForEachLeaf(table, set.Active, StepLeaf{ table, coefficients, buffers });
  return SumOfCounts(table, set, buffers);
}

GradientCounts SumOfCounts(
  const LeafTable& table, const ActiveSet& set, const SubstepBuffers& buffers)
{
  GradientCounts counts;
  counts.Nodes = table.Count([](const LeafSummary& leaf) { return leaf.ZeroNodes; });
  for (const std::int32_t i : set.Active)
  {
    counts.Flat += static_cast<std::size_t>(buffers.FlatNodes[i]);
    counts.Steep += static_cast<std::size_t>(buffers.SteepNodes[i]);
    counts.Unbounded = counts.Unbounded || buffers.Unbounded[i] != 0;
  }
  return counts;
}

void CommitStep(LeafTable& table, const ActiveSet& set, const SubstepBuffers& buffers)
{
  table.ForEach(set.Active,
    [&](std::size_t i)
    {
      std::copy_n(buffers.NextOf(i), 512, table[i].Value);
      table[i].Inside = InsideNodes(table[i].Value);
    });
  table.ForEach(set.Affected,
    [&](std::size_t i)
    {
      table[i].Updated = table[i].Active;
      table.SummaryOf(i).Speed.IsKnown = false;
    });
}

void ScalePotential(LeafTable& table, float factor)
{
  table.ForEach(
    [&](std::size_t i)
    {
      BandLeaf& leaf = table[i];
      leaf.UpToLayer[LastLayer].ForEach([&](int node) { leaf.Value[node] *= factor; });
    });
}

}
