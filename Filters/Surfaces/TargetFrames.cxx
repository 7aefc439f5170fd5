#include "TargetFrames.h"

#include <utility>

namespace activesurface
{

void TargetFrames::Clear()
{
  *this = TargetFrames();
}

void TargetFrames::Add(int step, TargetFrame frame)
{
  this->Earlier = std::move(this->Later);
  this->Later.Step = step;
  this->Later.Frame = std::move(frame);
  this->Matched = false;
}

bool TargetFrames::Has(int step) const
{
  return step >= 0 && (this->Earlier.Step == step || this->Later.Step == step);
}

const TargetFrame& TargetFrames::Get(int step) const
{
  return this->Later.Step == step ? this->Later.Frame : this->Earlier.Frame;
}

TargetFrame& TargetFrames::Get(int step)
{
  return this->Later.Step == step ? this->Later.Frame : this->Earlier.Frame;
}

void TargetFrames::PlaceParticles(int step, double fraction, std::vector<SkeletonVertex>& particles)
{
  if (fraction == 0.0 || this->Earlier.Step != step || this->Later.Step != step + 1)
  {
    particles = this->Get(step).Particles.Particles;
    return;
  }
  const ParticleFrame& earlier = this->Earlier.Frame.Particles;
  const ParticleFrame& later = this->Later.Frame.Particles;
  if (!this->Matched)
  {
    this->Matches = MatchParticles(earlier, later);
    this->Matched = true;
  }
  InterpolateParticles(earlier, later, this->Matches, fraction, particles);
}

}
