#include "ParticleTarget.h"

#include <algorithm>

namespace activesurface
{

ParticleTarget::ParticleTarget(
  ParticleFrames& frames, SkeletonKernel kernel, double threshold, const TargetOptions& options)
  : PotentialTarget(options)
  , Frames(frames)
  , Kernel(kernel)
  , Threshold(threshold)
{
}

void ParticleTarget::MoveAlong(int step, double begin, double end)
{
  this->Begin = begin;
  this->End = end;
  this->Place(step, 0.0);
}

void ParticleTarget::MoveTo(double time)
{
  const double length = this->End - this->Begin;
  const double fraction = length > 0.0 ? (time - this->Begin) / length : 0.0;
  this->Place(this->Step, std::min(std::max(fraction, 0.0), 1.0));
}

void ParticleTarget::Place(int step, double fraction)
{
  if (step == this->Step && fraction == this->Fraction)
  {
    return;
  }
  this->Step = step;
  this->Fraction = fraction;
  this->Frames.Interpolate(step, fraction, this->Particles);
  this->Elements.Clear();
  for (const SkeletonVertex& particle : this->Particles)
  {
    this->Elements.AddPoint(particle);
  }
  this->Elements.Build();
}

void ParticleTarget::Sample(
  std::size_t count, const double* points, double* values, double* gradients) const
{
  this->Elements.Evaluate(this->Kernel, this->Threshold, count, points, values, gradients);
}

}
