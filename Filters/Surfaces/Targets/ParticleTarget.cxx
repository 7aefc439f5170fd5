#include "Targets/ParticleTarget.h"

#include <algorithm>

namespace activesurface
{

namespace
{

bool IsSame(const SkeletonVertex& a, const SkeletonVertex& b)
{
  return std::equal(a.Position, a.Position + 3, b.Position) && a.Radius == b.Radius &&
    a.Strength == b.Strength;
}

ChangedRegion::Box SupportOf(const SkeletonVertex& particle)
{
  ChangedRegion::Box box;
  for (int axis = 0; axis < 3; ++axis)
  {
    box[2 * axis] = particle.Position[axis] - particle.Radius;
    box[2 * axis + 1] = particle.Position[axis] + particle.Radius;
  }
  return box;
}

}

ParticleTarget::ParticleTarget(
  const TargetFrames& frames, SkeletonKernel kernel, double threshold, const TargetOptions& options)
  : MovingTarget(options)
  , Frames(frames)
  , Kernel(kernel)
  , Threshold(threshold)
{
}

void ParticleTarget::Place(int step, double fraction)
{
  std::swap(this->Previous, this->Particles);
  this->Frames.PlaceParticles(step, fraction, this->Particles);
  this->FindChanged();
  this->Elements.Clear();
  for (const SkeletonVertex& particle : this->Particles)
  {
    this->Elements.AddPoint(particle);
  }
  this->Elements.Build();
}

// Sums go by the order of the particles: without those that are the same, they are the same.
void ParticleTarget::FindChanged()
{
  const std::size_t before = this->Previous.size(), now = this->Particles.size();
  const std::size_t most = std::max(before, now) / 2;
  this->ChangedSupports.clear();
  for (std::size_t i = 0; i < std::max(before, now) && this->ChangedSupports.size() <= most; ++i)
  {
    if (i < before && i < now && IsSame(this->Previous[i], this->Particles[i]))
    {
      continue;
    }
    if (i < before)
    {
      this->ChangedSupports.push_back(SupportOf(this->Previous[i]));
    }
    if (i < now)
    {
      this->ChangedSupports.push_back(SupportOf(this->Particles[i]));
    }
  }
  if (this->ChangedSupports.size() > most)
  {
    this->Changed.SetEverywhere(); // to look closer would not pay
  }
  else
  {
    this->Changed.Set(this->ChangedSupports);
  }
}

bool ParticleTarget::HasChangedIn(const double bounds[6]) const
{
  return this->Changed.Touches(bounds);
}

void ParticleTarget::Sample(
  std::size_t count, const double* points, double* values, double* gradients) const
{
  this->Elements.Evaluate(this->Kernel, this->Threshold, count, points, values, gradients);
}

}
