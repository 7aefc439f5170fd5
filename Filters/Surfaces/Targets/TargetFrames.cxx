#include "Targets/TargetFrames.h"

#include <utility>

namespace activesurface
{

void TargetFrames::Clear()
{
  *this = TargetFrames();
}

void TargetFrames::Add(int step, TargetFrame frame)
{
  this->Matched = false;
  if (this->Has(step))
  {
    this->Get(step) = std::move(frame);
    return;
  }
  this->Earlier = std::move(this->Later);
  this->Later.Step = step;
  this->Later.Frame = std::move(frame);
  if (this->Earlier.Step == step + 1)
  {
    std::swap(this->Earlier, this->Later);
  }
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

const ParticleMatches* TargetFrames::FindMatches(int step)
{
  if (this->Earlier.Step != step || this->Later.Step != step + 1)
  {
    return nullptr;
  }
  if (!this->Matched)
  {
    this->Matches = MatchParticles(this->Earlier.Frame.Particles, this->Later.Frame.Particles);
    this->Matched = true;
  }
  return &this->Matches;
}

void TargetFrames::PlaceParticles(int step, double fraction, std::vector<SkeletonVertex>& particles)
{
  const ParticleMatches* matches = fraction == 0.0 ? nullptr : this->FindMatches(step);
  if (!matches)
  {
    particles = this->Get(step).Particles.Particles;
    return;
  }
  InterpolateParticles(
    this->Earlier.Frame.Particles, this->Later.Frame.Particles, *matches, fraction, particles);
}

}
