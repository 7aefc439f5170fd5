#include "Simulation/SkinAttributes.h"

#include "March/Arrival.h"
#include "NarrowBand.h"
#include "Surface/SkinMotion.h"

#include <cmath>
#include <memory>

namespace activesurface
{

namespace
{

// Returns true if arrays use the interval before the requested step; false: the interval after this
// step, or none.
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
    (arrays.Speeds && (target.MayCarry() || target.MayHaveLabels()));
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

SkinAttributes::SkinAttributes(const SurfaceSettings& settings, const TargetBuilder& shapes,
  const Warnings& messages, const RequestedTime& time, const RequestedArrays& arrays)
  : Settings(settings)
  , Shapes(shapes)
  , Messages(messages)
  , Time(time)
  , Arrays(arrays)
{
}

std::vector<float> SkinAttributes::FindSpeeds(const NarrowBand& band, const Motion& motion) const
{
  if (band.IsEmpty())
  {
    return {};
  }
  const bool moves = this->Settings.Inputs.TargetMoves;
  int step = moves ? this->Time.Step : 0;
  if (this->Shapes.MayCarry() || this->Shapes.MayHaveLabels())
  {
    // Uses the interval of the particles' arrays, whichever frames are stored.
    step = FindArrayFrames(this->Settings, this->Time, this->Arrays, this->Shapes, true).First;
  }
  const int next = moves && this->Shapes.Has(step + 1) ? step + 1 : step;
  const double begin = this->Settings.GetMotionTimeOf(step).Value;
  const double end = this->Settings.GetMotionTimeOf(next).Value;
  const std::unique_ptr<PotentialTarget> target =
    this->Shapes.MakeTargetAt(step, begin, end, motion.Integration != TimeIntegration::Nodes);
  const SkinForces forces{ motion, *target, band.GetStartArea(), band.GetStartVolume(), begin,
    end };
  const SurfaceDomain* domain = this->Shapes.GetDomain();
  if (domain && this->Settings.ArrivesAfter({ band.GetTime() }))
  {
    const Arrival arriving(band, *target, domain->Bounds);
    return arriving.FindSpeeds(band, this->Settings.GetArrival().Value, forces);
  }
  return activesurface::FindSpeeds(band, forces);
}

PassedArrays SkinAttributes::FindPassedArrays() const
{
  PassedArrays passed;
  if (!this->Arrays.NeedParticles())
  {
    return passed;
  }
  if (!this->Shapes.MayHaveParticles())
  {
    if (this->Arrays.Passed)
    {
      this->Messages.Say("no particles",
        "PassTargetArrays has no effect here: the target has no particles; turn PassTargetArrays "
        "off.");
    }
    return passed;
  }
  const TargetFrames& frames = this->Shapes.GetFrames();
  const ArrayFrames found = FindArrayFrames(
    this->Settings, this->Time, this->Arrays, this->Shapes, this->Arrays.TangentialVelocity);
  const PeriodicBox box = this->Shapes.GetBox();
  const bool isAtEnd = found.Fraction == 1.0;
  passed.Particles = isAtEnd ? frames.GetTrackBack(found.First, box)
                             : frames.GetTrack(found.First, box, found.Fraction);
  passed.Particles->SetDuration(isAtEnd ? -found.Duration : found.Duration);
  passed.Kernel = this->Settings.Particles.Kernel;
  passed.Arrays = this->Arrays.Passed;
  if (this->Arrays.TangentialVelocity)
  {
    passed.Velocities = passed.Particles->ListVelocities();
  }
  return passed;
}

double SkinAttributes::FindFastestParticle(const PassedArrays& passed) const
{
  const TargetFrames& frames = this->Shapes.GetFrames();
  const ArrayFrames interval =
    FindArrayFrames(this->Settings, this->Time, this->Arrays, this->Shapes, true);
  const auto matches = frames.FindMatches(interval.First);
  if (!matches || !this->Settings.Inputs.TargetMoves)
  {
    return 0.0;
  }
  double fastest = FindLargestDisplacement(frames.GetParticles(interval.First),
                     frames.GetParticles(interval.First + 1), *matches, this->Shapes.GetBox()) /
    interval.Duration;
  const std::vector<double>& velocities = passed.Velocities;
  for (std::size_t i = 0; fastest > 0.0 && i < velocities.size(); i += 3)
  {
    const double speed = std::hypot(velocities[i], velocities[i + 1], velocities[i + 2]);
    fastest = speed > fastest ? speed : fastest; // false for NaN
  }
  return fastest;
}

}
