#include "Implicit/SurfaceMove.h"

#include "Implicit/StepPlan.h"
#include "Leaves/LeafKernels.h"
#include "Substep/RowKernels.h"
#include "Substep/SubstepBuffers.h"
#include "Substep/TargetSpeed.h"

#include <algorithm>
#include <cmath>

namespace activesurface
{

namespace
{

struct FindLeafDisplacements
{
  const LeafTable& Table;
  const MoveCoefficients& Coefficients;
  SubstepBuffers& Buffers;

  ACTIVE_ALWAYS_INLINE void operator()(std::size_t i) const
  {
    const BandLeaf& leaf = this->Table[i];
    const LeafMask crossed = NodesWithCrossing(this->Table, leaf);
    float* displacements = this->Buffers.SpeedOf(i);
    if (!this->Coefficients.HasTargetSpeed)
    {
      std::fill_n(displacements, 512, 0.f);
      this->Buffers.Known[i] = this->Buffers.NextKnown[i] = crossed;
    }
    if (!crossed.Any())
    {
      return;
    }
    LeafBlock block;
    block.Gather(this->Table, leaf);
    for (int row = 0; row < 64; ++row)
    {
      if (const unsigned nodes = crossed.Row(row / 8, row % 8))
      {
        this->FindRow(block.Row(row / 8, row % 8), nodes, displacements + 8 * row);
      }
    }
  }

private:
  ACTIVE_ALWAYS_INLINE void FindRow(const float* u, unsigned nodes, float* displacements) const
  {
    const RowMask& counts = MaskOfBits(nodes);
    float clamped[8], squares[8];
    ACTIVE_LANES
    for (int z = 0; z < 8; ++z)
    {
      clamped[z] = this->Clamp(displacements[z]);
    }
    if (this->Coefficients.IsUpwind)
    {
      UpwindGradientSquares(u, clamped, squares);
    }
    else
    {
      CentralGradientSquares(u, squares);
      TakeUpwindWhereFlat(u, nodes, clamped, squares);
    }
    ACTIVE_LANES
    for (int z = 0; z < 8; ++z)
    {
      const float product = clamped[z] * std::sqrt(squares[z]), speed = displacements[z];
      displacements[z] = counts[z] > 0.f ? product : speed;
    }
  }

  ACTIVE_ALWAYS_INLINE static void TakeUpwindWhereFlat(
    const float* u, unsigned nodes, const float* speed, float* squares)
  {
    bool isSteep = true;
    for (int z = 0; z < 8; ++z)
    {
      isSteep = isSteep && (squares[z] >= FlatGradientSquare || ((nodes >> z) & 1u) == 0);
    }
    if (isSteep)
    {
      return;
    }
    float upwind[8];
    UpwindGradientSquares(u, speed, upwind);
    for (int z = 0; z < 8; ++z)
    {
      const float larger = std::max(squares[z], upwind[z]);
      squares[z] = squares[z] < FlatGradientSquare ? larger : squares[z];
    }
  }

  ACTIVE_ALWAYS_INLINE float Clamp(float speed) const
  {
    const float whole = this->Coefficients.Factor * speed + this->Coefficients.Uniform;
    return std::min(std::max(whole, -LongestDisplacement), LongestDisplacement);
  }
};

/** IsSource: for stages that follow. */
template <bool IsSource>
struct MoveLeaf
{
  const LeafTable& Table;
  const MoveCoefficients& Coefficients;
  SubstepBuffers& Buffers;

  ACTIVE_ALWAYS_INLINE void operator()(std::size_t i) const
  {
    const BandLeaf& leaf = this->Table[i];
    LeafBlock block;
    block.Gather(this->Table, leaf);
    // Relaxing the ends of a crossed edge would move the surface.
    const LeafMask relaxed = leaf.Active.Without(NodesWithCrossing(this->Table, leaf));
    float* next = this->Buffers.NextOf(i); // holds the displacements
    if constexpr (IsSource)
    {
      std::fill_n(this->Buffers.StageSource.Of(i), 512, 0.f);
    }
    unsigned unbounded = 0;
    int flat = 0, steep = 0;
    for (int row = 0; row < 64; ++row)
    {
      const int x = row / 8, y = row % 8;
      const unsigned active = leaf.Active.Row(x, y);
      const float* u = block.Row(x, y);
      if (active == 0)
      {
        if constexpr (!IsSource)
        {
          std::copy_n(u, 8, next + 8 * row);
        }
        continue;
      }
      if constexpr (IsSource)
      {
        this->TakeToNodes(u, i, relaxed.Row(x, y), next + 8 * row);
        this->FindSource(
          u, active, relaxed.Row(x, y), next + 8 * row, this->Buffers.StageSource.Of(i) + 8 * row);
      }
      else
      {
        this->MoveRow(u, active, relaxed.Row(x, y), next + 8 * row, unbounded);
      }
      if (const unsigned zero = leaf.UpToLayer[0].Row(x, y))
      {
        CountGradients(u, zero, flat, steep);
      }
    }
    this->Buffers.FlatNodes[i] = flat;
    this->Buffers.SteepNodes[i] = steep;
    this->Buffers.Unbounded[i] = static_cast<std::uint8_t>(unbounded);
  }

private:
  /** Tension is proportional to |grad u| of the node, so what it balances has to be, too. */
  ACTIVE_ALWAYS_INLINE void TakeToNodes(
    const float* u, std::size_t i, unsigned nodes, float* displacements) const
  {
    if (nodes == 0 || !this->Coefficients.IsBalanced)
    {
      return;
    }
    const LeafBalance& balance = this->Buffers.Balances[i];
    const float share = balance.GetBalancedShare();
    if (share == 0.f)
    {
      return;
    }
    float squares[8];
    CentralGradientSquares(u, squares);
    const RowMask& counts = MaskOfBits(nodes);
    ACTIVE_LANES
    for (int z = 0; z < 8; ++z)
    {
      const float ratio =
        std::min(std::sqrt(std::max(squares[z], FlatGradientSquare)) / balance.Gradient, 2.f);
      displacements[z] *= 1.f + counts[z] * share * (ratio - 1.f);
    }
  }

  /** Relaxes a row. */
  ACTIVE_ALWAYS_INLINE void Relax(const float* u, unsigned nodes, float* next) const
  {
    RowMask relaxation = MaskOfBits(nodes);
    constexpr float still[8] = {};
    ACTIVE_LANES
    for (int z = 0; z < 8; ++z)
    {
      relaxation[z] *= this->Coefficients.Relaxation;
    }
    AddTransport(u, still, 0.f, relaxation, next);
  }

  ACTIVE_ALWAYS_INLINE void FindSource(const float* u, unsigned active, unsigned relaxed,
    const float* displacements, float* source) const
  {
    float change[8] = {};
    this->Relax(u, relaxed, change);
    const RowMask& moves = MaskOfBits(active);
    ACTIVE_LANES
    for (int z = 0; z < 8; ++z)
    {
      source[z] =
        moves[z] * this->Coefficients.SourcePerDisplacement * (displacements[z] - change[z]);
    }
  }

  ACTIVE_ALWAYS_INLINE void MoveRow(
    const float* u, unsigned active, unsigned relaxed, float* next, unsigned& unbounded) const
  {
    float to[8];
    ACTIVE_LANES
    for (int z = 0; z < 8; ++z)
    {
      to[z] = u[z] - next[z];
    }
    this->Relax(u, relaxed, to);
    TakeActive(u, to, active, next);
    unbounded |= AnyUnbounded(to, active);
  }
};

}

float DisplacementOf(
  std::size_t leaf, const MoveCoefficients& coefficients, const SubstepBuffers& buffers)
{
  const float tracked =
    coefficients.HasTargetSpeed ? coefficients.Factor * buffers.LargestSpeed[leaf] : 0.f;
  return tracked + std::fabs(coefficients.Uniform);
}

float LargestDisplacement(
  const LeafList& leaves, const MoveCoefficients& coefficients, const SubstepBuffers& buffers)
{
  float largest = 0.f;
  for (const std::int32_t i : leaves)
  {
    largest = std::max(largest, DisplacementOf(i, coefficients, buffers));
  }
  return largest;
}

void FindDisplacements(const LeafTable& table, const ActiveSet& set,
  const MoveCoefficients& coefficients, SubstepBuffers& buffers)
{
  if (!coefficients.HasTargetSpeed)
  {
    buffers.MakeRoomForNodes(table);
    buffers.Known.assign(table.Size(), LeafMask());
    buffers.NextKnown.assign(table.Size(), LeafMask());
  }
  ForEachLeaf(table, set.Affected, FindLeafDisplacements{ table, coefficients, buffers });
  TellSpeeds(table, set.Affected, false, buffers);
}

void ClearDisplacements(const LeafTable& table, const ActiveSet& set, SubstepBuffers& buffers)
{
  buffers.MakeRoomForNodes(table);
  table.ForEach(set.Active, [&](std::size_t i) { std::fill_n(buffers.SpeedOf(i), 512, 0.f); });
}

GradientCounts FindSources(const LeafTable& table, const ActiveSet& set,
  const MoveCoefficients& coefficients, SubstepBuffers& buffers)
{
  buffers.MakeRoomForCounts(table.Size());
  buffers.StageSource.MakeRoom(table);
  ForEachLeaf(table, set.Active, MoveLeaf<true>{ table, coefficients, buffers });
  return SumOfCounts(table, set, buffers);
}

GradientCounts MoveSurface(const LeafTable& table, const ActiveSet& set,
  const MoveCoefficients& coefficients, SubstepBuffers& buffers)
{
  buffers.MakeRoomForCounts(table.Size());
  ForEachLeaf(table, set.Active, MoveLeaf<false>{ table, coefficients, buffers });
  return SumOfCounts(table, set, buffers);
}

}
