// The particles at a time t, and their indices at the steps before and after t.

#ifndef ParticleMoment_h
#define ParticleMoment_h

#include "Frames/ParticleMatches.h"

#include <vector>

namespace activesurface
{

class TargetFrames;

struct ParticlesAtTime
{
  std::vector<SkeletonVertex> Particles;
  std::vector<ParticleOrigin> Origins; // of the particles
  // Frames to which the origins refer; null if not stored.
  const ParticleFrame* Earlier = nullptr;
  const ParticleFrame* Later = nullptr;
  double Fraction = 0.0; // of the interval from Earlier to Later, in [0,1]
  PeriodicBox Box;

  // Returns x y z for each particle, NaN where unknown: the velocities of the frames if available,
  // otherwise the displacement between the frames divided by `duration`.
  std::vector<double> FindVelocities(double duration) const;
};

// Interpolates the particles at a fraction of the interval from a step to the next one. The
// fractions 0 and 1 yield exactly the particles of one step. `step` has to be stored if fraction <
// 1, and step + 1 if fraction = 1. The result has pointers to the frames.
ParticlesAtTime FindParticlesAt(
  const TargetFrames& frames, int step, const PeriodicBox& box, double fraction);

// Interpolates a value linearly; a particle in only one of the steps keeps its value there.
double Mix(double earlier, double later, const ParticleOrigin& origin, double fraction);

}

#endif
