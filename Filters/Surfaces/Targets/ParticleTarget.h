// Moving particles as a target: F = threshold - sum of strength * kernel(distance / radius).
//
// Outside all supports F is the threshold, without a gradient: a skin out there is attracted with
// the constant speed that belongs to the target's reach.

#ifndef ParticleTarget_h
#define ParticleTarget_h

#include "Skeleton.h"
#include "Targets/ChangedRegion.h"
#include "Targets/MovingTarget.h"
#include "Targets/TargetFrames.h"

#include <vector>

namespace activesurface
{

class ParticleTarget : public MovingTarget
{
public:
  // The frames are the caller's, and have to hold what MoveAlong asks for.
  ParticleTarget(const TargetFrames& frames, SkeletonKernel kernel, double threshold,
    const TargetOptions& options);

protected:
  void Place(int step, double fraction) override;
  bool HasChangedIn(const double bounds[6]) const override;
  void Sample(
    std::size_t count, const double* points, double* values, double* gradients) const override;

private:
  void FindChanged();

  const TargetFrames& Frames;
  const SkeletonKernel Kernel;
  const double Threshold;
  std::vector<SkeletonVertex> Particles;
  std::vector<SkeletonVertex> Previous;
  std::vector<ChangedRegion::Box> ChangedSupports;
  ChangedRegion Changed; // from Previous to Particles
  Skeleton Elements;
};

}

#endif
