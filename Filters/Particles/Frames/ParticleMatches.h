// Matches the particles of two steps of the input, and defines their motion in between.
//
// A particle moves in a straight line to its position in the next step. In a periodic box, the
// particle moves to the nearest copy of this position. The particle's radius and strength change
// linearly. Particles are matched by their ids if both steps have ids. If neither has ids,
// particles are matched by the index of their point, if the steps have equally many points. Indices
// are ignored if the order of the particles seems to differ between the steps (AreShuffled).
//
// Let f be the elapsed fraction of the interval between the steps. A particle without a partner in
// the next step dies: its strength is multiplied by (1-f). A particle without a partner in the
// earlier step is born: its strength is multiplied by f. So the sum of kernels is continuous in
// time for any two steps.

#ifndef ParticleMatches_h
#define ParticleMatches_h

#include "Frames/ParticleFrame.h"
#include "Frames/PeriodicBox.h"

#include "vtkActiveParticlesModule.h"

#include <cstddef>
#include <vector>

namespace activesurface
{

constexpr std::size_t NoPartner = static_cast<std::size_t>(-1);

struct ParticleMatches
{
  // Index of the partner in the later step for each earlier particle, or NoPartner.
  std::vector<std::size_t> Partners;
  std::vector<std::size_t> Deaths; // earlier particles without a partner, ascending
  std::vector<std::size_t> Births; // later particles without a partner, ascending
  bool AreShuffled = false;        // an index seems to mean different particles in the two steps
};

VTKACTIVEPARTICLES_EXPORT ParticleMatches MatchParticles(
  const ParticleFrame& earlier, const ParticleFrame& later, const PeriodicBox& box);

// Pairs particles with the same ids or indices. Pairs no particles if areShuffled, or if only one
// step has ids, or if two steps without ids have different numbers of points.
VTKACTIVEPARTICLES_EXPORT ParticleMatches PairParticles(
  const ParticleFrame& earlier, const ParticleFrame& later, bool areShuffled);

// Returns the matches with the two steps exchanged. earlier: number of particles in the new earlier
// step.
VTKACTIVEPARTICLES_EXPORT ParticleMatches InvertMatches(
  const ParticleMatches& matches, std::size_t earlier);

// Displacement of a particle from step to step. Number: id, or index without ids.
struct NumberedDisplacement
{
  std::int64_t Number;
  double Displacement[3];
};

// Returns the displacements of matched particles whose Number is a multiple of a stride: at most
// about 1,000 if the numbers are consecutive.
VTKACTIVEPARTICLES_EXPORT std::vector<NumberedDisplacement> SampleDisplacements(
  const ParticleFrame& earlier, const ParticleFrame& later,
  const std::vector<std::size_t>& partners, const PeriodicBox& box);

// Returns true if an index seems to mean different particles in the two steps. displacements:
// samples from the whole frame, in any order. `earlier` may contain only a part of the frame if
// Whole is set.
VTKACTIVEPARTICLES_EXPORT bool AreShuffled(std::vector<NumberedDisplacement> displacements,
  const ParticleFrame& earlier, const PeriodicBox& box);

// Returns the maximum of displacement + change of support radius [length] over matched particles; 0
// without matched particles.
VTKACTIVEPARTICLES_EXPORT double FindLargestDisplacement(const ParticleFrame& earlier,
  const ParticleFrame& later, const ParticleMatches& matches, const PeriodicBox& box);

// Indices of a particle in the two steps; NoPartner in a step without the particle.
struct ParticleOrigin
{
  std::size_t Earlier;
  std::size_t Later;
};

// Finds the velocity (x y z) of a particle that moves uniformly from step to step. Returns false if
// the particle is in only one step (the other frame may be null), or if the duration is 0. The
// duration is negative if `earlier` is the later step.
VTKACTIVEPARTICLES_EXPORT bool FindVelocity(const ParticleFrame* earlier,
  const ParticleFrame* later, const ParticleOrigin& origin, const PeriodicBox& box, double duration,
  double (&velocity)[3]);

}

#endif
