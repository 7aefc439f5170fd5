#include "Simulation/RestartWarning.h"

#include "Simulation/Warnings.h"

#include <sstream>

namespace activesurface
{

namespace
{

// Returns true if the settings differ only by the data of an input without time steps.
bool AreDataReplaced(const SurfaceSettings& old, const SurfaceSettings& next)
{
  SurfaceSettings same = next;
  same.Inputs.TargetMTime = old.Inputs.TargetMTime;
  same.Inputs.InputSteps = old.Inputs.InputSteps;
  return old.UsesInput() && !old.Inputs.TargetMoves && !old.IsEquilibrium() &&
    old.Inputs.TargetMTime != 0 && next.Inputs.TargetMTime != 0 && same == old;
}

}

void RestartWarning::Note(
  const SurfaceSettings& old, const SurfaceSettings& next, bool hasBegun, PipelineTime requested)
{
  this->LastTime = hasBegun && AreDataReplaced(old, next) ? requested.Value : Never;
}

void RestartWarning::Tell(PipelineTime requested, const Warnings& messages)
{
  if (requested.Value > this->LastTime && !this->IsTold)
  {
    this->IsTold = true;
    std::ostringstream text;
    text << "The input was replaced after the time " << this->LastTime
         << ", so the surface was restarted. Replacing the input does not advance time: call "
            "Advance(particles, dt) for each frame, or connect a source that publishes TIME_STEPS "
            "(in Python: ParticleSeries, temporal_source).";
    messages.Say("replaced data", text.str());
  }
  this->LastTime = Never;
}

}
