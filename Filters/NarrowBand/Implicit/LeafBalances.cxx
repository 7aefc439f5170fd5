#include "Implicit/LeafBalances.h"

#include "Leaves/LeafExchange.h"
#include "Leaves/LeafKernels.h"
#include "Substep/RowKernels.h"
#include "Substep/SubstepBuffers.h"

#include <algorithm>
#include <cmath>

namespace activesurface
{

namespace
{

template <bool IsWeighted>
struct FindLeafBalance
{
  const LeafTable& Table;
  const MoveCoefficients& Coefficients;
  SubstepBuffers& Buffers;

  ACTIVE_ALWAYS_INLINE void operator()(std::size_t i) const
  {
    const BandLeaf& leaf = this->Table[i];
    const LeafMask crossed = NodesWithCrossing(this->Table, leaf);
    LeafBalance balance;
    if (crossed.Any())
    {
      LeafBlock block;
      block.Gather(this->Table, leaf);
      for (int row = 0; row < 64; ++row)
      {
        if (const unsigned nodes = crossed.Row(row / 8, row % 8))
        {
          this->AddRow(block.Row(row / 8, row % 8), i, row, nodes, balance);
        }
      }
      balance.Gradient /= static_cast<float>(crossed.Count());
    }
    this->Buffers.Balances[i] = balance;
  }

private:
  ACTIVE_ALWAYS_INLINE void AddRow(
    const float* u, std::size_t i, int row, unsigned nodes, LeafBalance& balance) const
  {
    float rates[8] = {}, squares[8];
    if constexpr (IsWeighted)
    {
      AddWeightedTension(u, this->Coefficients.Tension, this->Buffers.WeightOf(i) + 8 * row, rates);
    }
    else
    {
      AddTension(u, this->Coefficients.Tension, rates);
    }
    CentralGradientSquares(u, squares);
    const float* speeds = this->Buffers.SpeedOf(i) + 8 * row;
    const RowMask& counts = MaskOfBits(nodes);
    const float uniform = this->Coefficients.Uniform, factor = this->Coefficients.Factor;
    const bool hasSpeed = this->Coefficients.HasTargetSpeed;
    float gradients[8], tensions[8], others[8], nets[8];
    ACTIVE_LANES
    for (int z = 0; z < 8; ++z)
    {
      const float gradient = std::sqrt(std::max(squares[z], FlatGradientSquare));
      const float tension = -rates[z] / gradient;
      const float speed = speeds[z];
      const float other = uniform + (hasSpeed ? factor * speed : 0.f);
      nets[z] = counts[z] * std::fabs(tension + other);
      tensions[z] = std::min(counts[z] * std::fabs(tension), nets[z]);
      others[z] = counts[z] * std::fabs(other);
      gradients[z] = counts[z] * gradient;
    }
    for (int z = 0; z < 8; ++z)
    {
      balance.Tension = std::max(balance.Tension, tensions[z]);
      balance.Net = std::max(balance.Net, nets[z]);
      balance.Others = std::max(balance.Others, others[z]);
      balance.Gradient += gradients[z];
    }
  }
};

}

void FindBalances(const LeafTable& table, const LeafList& leaves,
  const MoveCoefficients& coefficients, bool isWeighted, SubstepBuffers& buffers)
{
  buffers.MakeRoomForNodes(table);
  buffers.Balances.resize(table.Size());
  if (isWeighted)
  {
    ForEachLeaf(table, leaves, FindLeafBalance<true>{ table, coefficients, buffers });
  }
  else
  {
    ForEachLeaf(table, leaves, FindLeafBalance<false>{ table, coefficients, buffers });
  }
  TellAll(table, leaves, [&](std::size_t i, auto& pass) { pass(&buffers.Balances[i], 1); });
}

}
