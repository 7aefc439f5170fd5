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
    text << "The input's data are others than at the last update, for the time " << this->LastTime
         << ", so the motion has started anew: data that replace each other are no time steps. For "
            "a skin that lives on, push each frame by Advance(particles, dt), or connect a source "
            "with TIME_STEPS (in Python: ParticleSeries, temporal_source).";
    messages.Say("replaced data", text.str());
  }
  this->LastTime = Never;
}

}
