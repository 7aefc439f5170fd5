// The way of particles from a step of the input to the next, see ParticleMatches.h.

#ifndef ParticleWay_h
#define ParticleWay_h

#include "Targets/ParticleMatches.h"

#include <vector>

namespace activesurface
{

struct ParticleWay
{
  const ParticleFrame* Earlier;
  const ParticleFrame* Later = nullptr;     // null, and so the matches, where no next step is held
  const ParticleMatches* Matches = nullptr; // of the two
};

// What is to be known of particles besides where they are.
struct PlacedNeeds
{
  bool Fits = false;
  bool Velocities = false;
  double Duration = 0.0; // of the way [motion time]; 0: none
};

struct PlacedParticles
{
  std::vector<SkeletonVertex> Particles;
  ParticleFits Fits;              // of each, or empty
  std::vector<double> Velocities; // of each, x y z, NaN for unknown; or empty
  std::vector<ParticleOrigin> Origins;
};

// The particles at a fraction in [0,1] of the way; those of the earlier step, in their order, at 0
// and where there is no next step. Keeps the memory of what it writes to.
void PlaceParticles(
  const ParticleWay& way, double fraction, const PlacedNeeds& needs, PlacedParticles& placed);

}

#endif
