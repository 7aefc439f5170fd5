#include "ParticleTarget.h"

namespace activesurface
{

ParticleTarget::ParticleTarget(
  TargetFrames& frames, SkeletonKernel kernel, double threshold, const TargetOptions& options)
  : MovingTarget(options)
  , Frames(frames)
  , Kernel(kernel)
  , Threshold(threshold)
{
}

void ParticleTarget::Place(int step, double fraction)
{
  this->Frames.PlaceParticles(step, fraction, this->Particles);
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
