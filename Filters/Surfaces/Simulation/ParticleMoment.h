// The particles at a time, and their indices at the steps before and after it.

#ifndef ParticleMoment_h
#define ParticleMoment_h

#include "Frames/ParticleMatches.h"

#include <vector>

namespace activesurface
{

class TargetFrames;

struct ParticleMoment
{
  std::vector<SkeletonVertex> Particles;
  std::vector<ParticleOrigin> Origins; // of the particles
  // Frames that the origins index; null if not held.
  const ParticleFrame* Earlier = nullptr;
  const ParticleFrame* Later = nullptr;
  double Fraction = 0.0; // of the interval from Earlier to Later, in [0,1]
  PeriodicBox Box;

  // Returns x y z for each particle, NaN where unknown: the velocities of the frames if one of them
  // has any, else the displacement between the frames over `duration`.
  std::vector<double> FindVelocities(double duration) const;
};

// Interpolates the particles at a fraction of the interval from a step to the next one. 0 and 1
// yield exactly the particles of one step. The frames have to hold `step` if fraction < 1, else the
// step after it. The result refers to the frames.
ParticleMoment FindMoment(
  const TargetFrames& frames, int step, const PeriodicBox& box, double fraction);

// Interpolates a value linearly; a particle that is in one of the steps only keeps its value there.
double Mix(double earlier, double later, const ParticleOrigin& origin, double fraction);

}

#endif
