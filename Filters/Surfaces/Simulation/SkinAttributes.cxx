#include "Simulation/SkinAttributes.h"

#include "NarrowBand.h"
#include "SkinMotion.h"

namespace activesurface
{

SkinAttributes::SkinAttributes(const SurfaceSettings& settings, SurfaceShapes& shapes,
  Warnings& messages, const RequestedTime& time, const RequestedArrays& arrays)
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
  MovingTarget* moving = this->Shapes.GetMovingTarget();
  if (moving && this->Settings.Inputs.TargetMoves)
  {
    const int step = this->Time.Step;
    const int next = this->Shapes.Has(step + 1) ? step + 1 : step;
    moving->MoveAlong(
      step, this->Settings.GetMotionTimeOf(step).Value, this->Settings.GetMotionTimeOf(next).Value);
  }
  return activesurface::FindSpeeds(
    band, { motion, this->Shapes.GetTarget(), band.GetStartArea(), band.GetStartVolume() });
}

PassedArrays SkinAttributes::FindPassedArrays() const
{
  PassedArrays passed;
  if (!this->Arrays.NeedParticles())
  {
    return passed;
  }
  if (this->Shapes.GetKind() != TargetKind::Particles)
  {
    this->Messages.Say("no particles",
      "PassTargetArrays and TangentialVelocity do nothing here: the target has no particles.");
    return passed;
  }
  TargetFrames& frames = this->Shapes.GetFrames();
  const ArrayFrames found = FindArrayFrames(this->Settings, this->Time, this->Arrays, frames);
  passed.Moment = FindMoment(frames, found.First, found.Fraction);
  passed.Kernel = this->Settings.Particles.Kernel;
  passed.Arrays = this->Arrays.ParticleArrays;
  if (this->Arrays.TangentialVelocity)
  {
    passed.Velocities = passed.Moment.FindVelocities(found.Duration);
  }
  return passed;
}

}
