// Moving particles as a target: F = threshold - sum of strength * kernel(distance / radius).
//
// Outside all supports F is the threshold, without a gradient: a skin out there is attracted with
// the constant speed that belongs to the target's reach.

#ifndef ParticleTarget_h
#define ParticleTarget_h

#include "ParticleFrames.h"
#include "PotentialTarget.h"
#include "Skeleton.h"

#include <vector>

namespace activesurface
{

class ParticleTarget : public PotentialTarget
{
public:
  // The frames are the caller's, and have to hold what MoveAlong asks for.
  ParticleTarget(
    ParticleFrames& frames, SkeletonKernel kernel, double threshold, const TargetOptions& options);

  // From now on the particles go from this step to the next between two motion times, where they
  // begin at once. Without a next step, or if end = begin, they stay.
  void MoveAlong(int step, double begin, double end);

  void MoveTo(double time) override;

protected:
  void Sample(
    std::size_t count, const double* points, double* values, double* gradients) const override;

private:
  void Place(int step, double fraction);

  ParticleFrames& Frames;
  const SkeletonKernel Kernel;
  const double Threshold;
  int Step = -1;
  double Begin = 0.0;
  double End = 0.0;
  double Fraction = 0.0;
  std::vector<SkeletonVertex> Particles;
  Skeleton Elements;
};

}

#endif
