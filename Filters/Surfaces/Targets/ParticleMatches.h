// Which particles of two steps of the input are the same, and their way from one to the other.
//
// A particle moves in a straight line from one step to the next, in a periodic box to the nearest
// of its copies there, and its radius and strength change evenly. Particles are matched by their
// ids, or by their index where there are none and the steps have equally many, else not at all; nor
// where indices would send most of them across the cloud, as of an input that lists them in another
// order each time. One without a partner in the next step dies: at a fraction f of the way it has 1
// - f of its strength. One without a partner in the step before is born: it has f of its strength.
// So their sum is continuous in time, whatever the steps hold.

#ifndef ParticleMatches_h
#define ParticleMatches_h

#include "Targets/ParticleFrame.h"
#include "Targets/PeriodicBox.h"

#include <cstddef>
#include <vector>

namespace activesurface
{

constexpr std::size_t NoPartner = static_cast<std::size_t>(-1);

struct ParticleMatches
{
  // For each earlier one its partner's place among the later, or NoPartner.
  std::vector<std::size_t> Partners;
  std::vector<std::size_t> Deaths; // earlier ones without a partner, by ascending place
  std::vector<std::size_t> Births; // later ones that are nobody's partner, by ascending place
  bool AreShuffled = false;        // indices are not the same particles
};

ParticleMatches MatchParticles(
  const ParticleFrame& earlier, const ParticleFrame& later, const PeriodicBox& box);

// Pairs particles with the same ids or indices, unless these cannot be the same, or are shuffled.
ParticleMatches PairParticles(
  const ParticleFrame& earlier, const ParticleFrame& later, bool areShuffled);

// The displacement of a particle from step to step, and its index.
struct NumberedWay
{
  std::int64_t Number;
  double Way[3];
};

// Displacements of about a thousand partners at most, evenly picked by their index.
std::vector<NumberedWay> PickWays(const ParticleFrame& earlier, const ParticleFrame& later,
  const std::vector<std::size_t>& partners, const PeriodicBox& box);

// Returns true if the displacements, of the whole frame in any order, are those of different
// particles with the same index. earlier may be a part of the frame.
bool AreShuffled(
  std::vector<NumberedWay> ways, const ParticleFrame& earlier, const PeriodicBox& box);

// How far the fastest of the particles goes that are in both steps, its way and the change of its
// radius together; 0 if none is.
double FindLongestWay(const ParticleFrame& earlier, const ParticleFrame& later,
  const ParticleMatches& matches, const PeriodicBox& box);

// A particle's places in the two steps; NoPartner where it is not in the step.
struct ParticleOrigin
{
  std::size_t Earlier;
  std::size_t Later;
};

// Finds x y z of a particle that moves evenly from step to step in a duration. Returns false if it
// is in one of the steps only, or the duration is 0; a step may be null then.
bool FindVelocity(const ParticleFrame* earlier, const ParticleFrame* later,
  const ParticleOrigin& origin, const PeriodicBox& box, double duration, double (&velocity)[3]);

}

#endif
