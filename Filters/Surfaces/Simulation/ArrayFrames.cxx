#include "Simulation/ArrayFrames.h"

#include <algorithm>

namespace activesurface
{

namespace
{

// Whether the velocities of particles are those on the way to the requested step, from the step
// before.
bool LooksBack(const SurfaceSettings& settings, const RequestedTime& time,
  const RequestedArrays& arrays, const TargetFrames& frames)
{
  const int before = time.Step - 1;
  return arrays.TangentialVelocity && !time.Between && before >= 0 &&
    (!settings.Inputs.OnlyForward || HasArrays(frames, before, arrays));
}

}

bool HasArrays(const TargetFrames& frames, int step, const RequestedArrays& arrays)
{
  const InputShape* shape = frames.Find(step);
  return shape && (!arrays.NeedParticles() || shape->HasArrays(arrays.Kept));
}

ArrayFrames FindArrayFrames(const SurfaceSettings& settings, const RequestedTime& time,
  const RequestedArrays& arrays, const TargetFrames& frames)
{
  ArrayFrames found;
  if (!settings.Inputs.TargetMoves)
  {
    return found;
  }
  const int last = settings.GetNumberOfSteps() - 1;
  const bool looksBack = LooksBack(settings, time, arrays, frames);
  const bool looksAhead = time.Between || (arrays.TangentialVelocity && time.Step == 0);
  found.First = time.Step - (looksBack ? 1 : 0);
  found.Last = std::min(time.Step + (looksAhead ? 1 : 0), last);
  const double begin = settings.GetMotionTimeOf(found.First).Value;
  found.Duration = settings.GetMotionTimeOf(std::min(found.First + 1, last)).Value - begin;
  found.Fraction = looksBack ? 1.0
    : time.Between           ? (settings.ToMotionTime(time.Time).Value - begin) / found.Duration
                             : 0.0;
  return found;
}

}
