#include "Substep/UpstreamSpeed.h"

#include "Leaves/LeafKernels.h"
#include "Substep/SampleGradients.h"
#include "Substep/SamplePoints.h"
#include "Substep/SubstepBuffers.h"
#include "Substep/TargetSpeed.h"

namespace activesurface
{

namespace
{

/** Of one leaf: V - dt/2 w . grad V at the samples, which are inward speeds. */
struct ShiftSamples
{
  const LeafTable& Table;
  const Motion& Parameters;
  const float Advection;
  SubstepBuffers& Buffers;

  ACTIVE_ALWAYS_INLINE void operator()(std::size_t i) const
  {
    const std::size_t count = static_cast<std::size_t>(this->Table[i].Crossings);
    if (count == 0)
    {
      return;
    }
    const SampleGradients gradients(this->Table, i, this->Parameters,
      [this](std::int32_t n) ACTIVE_INLINED
      { return static_cast<const float*>(this->Buffers.SpeedOf(n)); });
    const std::int64_t first = this->Buffers.FirstSample[i];
    float* samples = this->Buffers.Samples.data() + first;
    const float* drifts = this->Buffers.Drifts.data() + 3 * first;
    for (std::size_t n = 0; n < count; ++n)
    {
      samples[n] += .5f * this->Advection * gradients.Dot(n, drifts + 3 * n);
    }
  }
};

}

void TakeSpeedUpstream(const LeafTable& table, const ActiveSet& set, const Motion& motion,
  float advection, SubstepBuffers& buffers)
{
  if (SamplesCrossings(motion))
  {
    ExtendSpeedOnce(table, set, motion, buffers); // gradients read the neighbours too
    ForEachLeaf(table, set.Active, ShiftSamples{ table, motion, advection, buffers });
    TellSamples(table, set.Active, motion, buffers);
    ApplySamples(table, set.Affected, motion, buffers);
  }
}

}
