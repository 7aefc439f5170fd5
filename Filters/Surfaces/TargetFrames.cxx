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

void TargetFrames::InterpolateParticles(
  int step, double fraction, std::vector<SkeletonVertex>& particles)
{
  particles = this->Get(step).Particles.Particles;
  if (fraction == 0.0 || this->Earlier.Step != step || this->Later.Step != step + 1)
  {
    return;
  }
  if (!this->Matched)
  {
    this->Partners = FindPartners(this->Earlier.Frame.Particles, this->Later.Frame.Particles);
    this->Matched = true;
  }
  MoveToPartners(this->Later.Frame.Particles, this->Partners, fraction, particles);
}

}
