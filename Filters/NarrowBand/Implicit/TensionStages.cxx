#include "Implicit/TensionStages.h"

#include "Implicit/StepPlan.h"
#include "Leaves/GhostFill.h"
#include "Leaves/LeafExchange.h"
#include "Leaves/LeafKernels.h"
#include "Substep/RowKernels.h"
#include "Substep/StepForward.h"
#include "Substep/SubstepBuffers.h"

#include <algorithm>
#include <cmath>

namespace activesurface
{

namespace
{

/** A stage, and the rates times dt. */
struct StageFactors
{
  float Now, Before;     //< of the potential after the last stage and the one before it
  float Rate, FirstRate; //< of the rate now, at first
  float Tension, Damping;
  float MostTension; //< that no source balances
};

StageFactors FactorsOf(const LegendreStage& stage, const StepPlan& plan)
{
  return { static_cast<float>(stage.Mu), static_cast<float>(stage.Nu),
    static_cast<float>(stage.Rate), static_cast<float>(stage.FirstRate),
    static_cast<float>(plan.GetTension()), static_cast<float>(plan.GetDamping()),
    static_cast<float>(LongestDisplacementByTension * plan.GetSourcePerDisplacement()) };
}

/** What the stages keep: the potential at first, the rate at first, and the source. */
struct StageRoom
{
  float* First;
  float* FirstRate;
  const float* Source;
};

template <bool IsWeighted>
ACTIVE_ALWAYS_INLINE void AddRate(const float* u, const float* weights, float* rate)
{
  if constexpr (IsWeighted)
  {
    AddWeightedTension(u, 1.f, weights, rate);
  }
  else
  {
    AddTension(u, 1.f, rate);
  }
}

/** Next, which holds the potential before the last stage, becomes that after this one. */
template <bool IsWeighted>
struct MakeStage
{
  const LeafTable& Table;
  StageFactors Factors;
  bool IsFirst;
  bool KeepsFirstRate;
  SubstepBuffers& Buffers;

  ACTIVE_ALWAYS_INLINE void operator()(std::size_t i) const
  {
    const BandLeaf& leaf = this->Table[i];
    LeafBlock block;
    block.Gather(this->Table, leaf);
    const StageRoom room = { this->Buffers.StageFirst.Of(i),
      this->KeepsFirstRate ? this->Buffers.StageRate.Of(i) : nullptr,
      this->Buffers.StageSource.Of(i) };
    float* next = this->Buffers.NextOf(i);
    unsigned unbounded = 0;
    for (int row = 0; row < 64; ++row)
    {
      const float* u = block.Row(row / 8, row % 8);
      const unsigned active = leaf.Active.Row(row / 8, row % 8);
      if (active == 0)
      {
        std::copy_n(u, 8, next + 8 * row);
        continue;
      }
      float result[8];
      this->MakeRow(u, IsWeighted ? this->Buffers.WeightOf(i) + 8 * row : nullptr, room, row,
        next + 8 * row, result);
      TakeActive(u, result, active, next + 8 * row);
      unbounded |= AnyUnbounded(result, active);
    }
    this->Buffers.Unbounded[i] = static_cast<std::uint8_t>(unbounded);
  }

private:
  ACTIVE_ALWAYS_INLINE void MakeRow(const float* u, const float* weights, const StageRoom& room,
    int row, const float* before, float* result) const
  {
    float rate[8] = {};
    AddRate<IsWeighted>(u, weights, rate);
    float* first = room.First + 8 * row;
    if (this->IsFirst)
    {
      std::copy_n(u, 8, first);
    }
    const StageFactors& f = this->Factors;
    ACTIVE_LANES
    for (int z = 0; z < 8; ++z)
    {
      const float pull = -room.Source[8 * row + z];
      const float whole = f.Tension * rate[z] + f.Damping * (first[z] - u[z]) + pull;
      rate[z] = std::min(
        std::max(whole, std::min(pull, 0.f) - f.MostTension), std::max(pull, 0.f) + f.MostTension);
      rate[z] += f.Damping * (u[z] - first[z]);
    }
    if (this->KeepsFirstRate && this->IsFirst)
    {
      std::copy_n(rate, 8, room.FirstRate + 8 * row);
    }
    static constexpr float none[8] = {};
    const float* firstRate = this->KeepsFirstRate ? room.FirstRate + 8 * row : none;
    this->IsFirst ? this->MakeFirst(first, rate, result)
                  : this->MakeNext(u, first, before, rate, firstRate, result);
  }

  // By differences, so that what does not change keeps its bits.
  ACTIVE_ALWAYS_INLINE void MakeFirst(const float* first, const float* rate, float* result) const
  {
    const StageFactors& f = this->Factors;
    const float damped = 1.f / (1.f + f.Rate * f.Damping);
    ACTIVE_LANES
    for (int z = 0; z < 8; ++z)
    {
      result[z] = first[z] + damped * (f.Rate * rate[z]);
    }
  }

  ACTIVE_ALWAYS_INLINE void MakeNext(const float* u, const float* first, const float* before,
    const float* rate, const float* firstRate, float* result) const
  {
    const StageFactors& f = this->Factors;
    const float damped = 1.f / (1.f + f.Rate * f.Damping);
    ACTIVE_LANES
    for (int z = 0; z < 8; ++z)
    {
      const float change = f.Now * (u[z] - first[z]) + f.Before * (before[z] - first[z]) +
        (f.Rate * rate[z] + f.FirstRate * firstRate[z]);
      result[z] = first[z] + damped * change;
    }
  }
};

template <bool IsWeighted>
void RunStage(const LeafTable& table, const ActiveSet& set, const StepPlan& plan, int number,
  SubstepBuffers& buffers)
{
  const LegendreStages& stages = *plan.GetStages();
  ForEachLeaf(table, set.Active,
    MakeStage<IsWeighted>{ table, FactorsOf(stages[number], plan), number == 1,
      stages.GetOrder() == StageOrder::Second, buffers });
}

/** What was the potential is kept for the next stage. */
void TakeValues(LeafTable& table, const ActiveSet& set, SubstepBuffers& buffers)
{
  table.ForEach(set.Active,
    [&](std::size_t i)
    {
      const LeafMask& active = table[i].Active;
      for (int row = 0; row < 64; ++row)
      {
        if (active.Row(row / 8, row % 8) != 0)
        {
          float* next = buffers.NextOf(i) + 8 * row;
          std::swap_ranges(next, next + 8, table[i].Value + 8 * row);
        }
      }
    });
  TellNeighbours(table, set.Active,
    [&table](std::size_t i, auto& pass) { PassNodes(table[i].Value, table[i].Active, pass); });
}

}

bool MakeTensionStages(LeafTable& table, const ActiveSet& set, const StepPlan& plan,
  bool isWeighted, SubstepBuffers& buffers)
{
  const int last = plan.GetStages()->GetNumberOfStages();
  buffers.MakeRoomForNodes(table);
  buffers.MakeRoomForCounts(table.Size());
  buffers.StageFirst.MakeRoom(table);
  if (plan.GetStages()->GetOrder() == StageOrder::Second)
  {
    buffers.StageRate.MakeRoom(table);
  }
  bool isBounded = true;
  for (int number = 1; number <= last && isBounded; ++number)
  {
    isWeighted ? RunStage<true>(table, set, plan, number, buffers)
               : RunStage<false>(table, set, plan, number, buffers);
    isBounded = !IsSoOnAny(table,
      std::any_of(set.Active.begin(), set.Active.end(),
        [&](std::int32_t i) { return table.IsOwn(i) && buffers.Unbounded[i] != 0; }));
    if (isBounded && number < last)
    {
      TakeValues(table, set, buffers);
      FillGhostsOfOldLayers(table, set);
    }
  }
  return isBounded;
}

}
