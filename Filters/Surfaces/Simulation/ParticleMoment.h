// The particles at a moment, and what they were at the steps before and after it.

#ifndef ParticleMoment_h
#define ParticleMoment_h

#include "Targets/ParticleMatches.h"

#include <vector>

namespace activesurface
{

class TargetFrames;

struct ParticleMoment
{
  std::vector<SkeletonVertex> Particles;
  std::vector<ParticleOrigin> Origins; // of the particles
  // Which the origins tell of; null if not known.
  const ParticleFrame* Earlier = nullptr;
  const ParticleFrame* Later = nullptr;
  double Fraction = 0.0; // of the way from Earlier to Later
  PeriodicBox Box;

  // x y z of each particle, NaN where it is not known: from the frames' velocities if they have
  // them, else from the way between the frames, which takes so long.
  std::vector<double> FindVelocities(double duration) const;
};

// At a fraction of the way from a step to the next one; at 0 and 1 exactly the particles of that
// step. The moment refers to the frames, which have to hold the step where it is.
ParticleMoment FindMoment(
  const TargetFrames& frames, int step, const PeriodicBox& box, double fraction);

// An array's tuple, or another quantity, between the two steps.
double Mix(double earlier, double later, const ParticleOrigin& origin, double fraction);

}

#endif
