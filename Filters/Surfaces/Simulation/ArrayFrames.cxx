#include "Simulation/ArrayFrames.h"

#include <algorithm>

namespace activesurface
{

namespace
{

// Returns true for the interval before the requested step, false for the one after it.
bool LooksBack(const SurfaceSettings& settings, const RequestedTime& time,
  const RequestedArrays& arrays, const TargetBuilder& target)
{
  const int before = time.Step - 1;
  return !time.Between && before >= 0 &&
    (!settings.Inputs.OnlyForward || HasArrays(target, before, arrays));
}

}

bool HasArrays(const TargetBuilder& target, int step, const RequestedArrays& arrays)
{
  const InputShape* shape = target.GetFrames().Find(step);
  return shape && (!arrays.NeedParticles() || shape->HasArrays(arrays.Kept));
}

bool WantDisplacements(const RequestedArrays& arrays, const TargetBuilder& target)
{
  return arrays.TangentialVelocity || (arrays.FastestParticle && target.MayHaveParticles()) ||
    (arrays.Speeds && target.MayCarry());
}

ArrayFrames FindArrayFrames(const SurfaceSettings& settings, const RequestedTime& time,
  const RequestedArrays& arrays, const TargetBuilder& target, bool wantsInterval)
{
  ArrayFrames found;
  if (!settings.Inputs.TargetMoves)
  {
    return found;
  }
  const int last = settings.GetNumberOfSteps() - 1;
  const bool looksBack = wantsInterval && LooksBack(settings, time, arrays, target);
  const bool looksAhead = time.Between || (wantsInterval && time.Step == 0);
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
