#include "Implicit/StageWeights.h"

#include "Leaves/LeafExchange.h"
#include "Substep/SubstepBuffers.h"
#include "Substep/TargetSpeed.h"

#include <algorithm>

namespace activesurface
{

void StageWeights::Remember(const ActiveSet& set, const SubstepBuffers& buffers)
{
  this->Known.resize(buffers.Known.size());
  for (const std::int32_t i : set.Active)
  {
    this->Known[i] = buffers.Known[i];
  }
}

void StageWeights::ExtendToEntered(
  const LeafTable& table, const ActiveSet& set, const Motion& motion, SubstepBuffers& buffers)
{
  const std::size_t size = table.Size();
  this->Known.resize(size);
  const bool hasEntered = IsSoOnAny(table,
    std::any_of(set.Active.begin(), set.Active.end(),
      [&](std::int32_t i)
      { return table.IsOwn(i) && table[i].Active.Without(this->Known[i]).Any(); }));
  if (!hasEntered)
  {
    return;
  }
  buffers.MakeRoomForNodes(table);
  buffers.Weights.MakeRoom(table);
  buffers.Known = buffers.NextKnown = this->Known;
  table.ForEach(set.Active,
    [&](std::size_t i)
    {
      LeafMask::All()
        .Without(this->Known[i])
        .ForEach(
          [&](int node)
          {
            buffers.WeightOf(i)[node] = 1.f;
            buffers.SpeedOf(i)[node] = 0.f; // extended as well, to no use
          });
    });
  TellSpeeds(table, set.Affected, true, buffers);
  ExtendSpeed(table, set, motion, buffers);
}

}
