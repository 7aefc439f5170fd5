// Which particles of two steps of the input are the same, and their way from one to the other.
//
// A particle moves in a straight line from one step to the next, and its radius and strength change
// evenly. Particles are matched by their ids, or by their index where there are none and the steps
// have equally many, else not at all; nor where indices would send most of them across the cloud,
// as of an input that lists them in another order each time. One without a partner in the next step
// dies: at a fraction f of the way it has 1 - f of its strength. One without a partner in the step
// before is born: it has f of its strength. So their sum is continuous in time, whatever the steps
// hold.

#ifndef ParticleMatches_h
#define ParticleMatches_h

#include "Targets/ParticleFrame.h"

#include <cstddef>
#include <vector>

namespace activesurface
{

constexpr std::size_t NoPartner = static_cast<std::size_t>(-1);

struct ParticleMatches
{
  // For each earlier one its partner's place among the later, or NoPartner.
  std::vector<std::size_t> Partners;
  std::vector<std::size_t> Births; // of the later ones, by ascending place
  bool AreShuffled = false;        // indices are not the same particles
};

ParticleMatches MatchParticles(const ParticleFrame& earlier, const ParticleFrame& later);

// How far the fastest of the particles goes that are in both steps, its way and the change of its
// radius together; 0 if none is.
double FindLongestWay(
  const ParticleFrame& earlier, const ParticleFrame& later, const ParticleMatches& matches);

// A particle's places in the two steps; NoPartner where it is not in the step.
struct ParticleOrigin
{
  std::size_t Earlier;
  std::size_t Later;
};

// Replaces particles by those at a fraction in [0,1] of the way from the earlier step to the later:
// the earlier ones in their order, then the births in theirs, none that has faded to nothing. And
// their origins, unless these are null.
void InterpolateParticles(const ParticleFrame& earlier, const ParticleFrame& later,
  const ParticleMatches& matches, double fraction, std::vector<SkeletonVertex>& particles,
  std::vector<ParticleOrigin>* origins = nullptr);

// What the particles at such origins are among their neighbours. One that fades shrinks with its
// volume: a lone particle grows from nothing.
void InterpolateFits(const ParticleFrame& earlier, const ParticleFrame& later, double fraction,
  const std::vector<ParticleOrigin>& origins, ParticleFits& fits);

// The origins of a step's particles, with their partners in the next one; matches: null without
// one.
void FindOriginsOfEarlier(
  std::size_t count, const ParticleMatches* matches, std::vector<ParticleOrigin>& origins);

// How the particles at such origins move in the interpolation, which takes so long: x y z each, NaN
// for those that are in one of the steps only. A frame may be null where no origin is in it.
void FindMotion(const ParticleFrame* earlier, const ParticleFrame* later, double duration,
  const std::vector<ParticleOrigin>& origins, std::vector<double>& velocities);

}

#endif
