// Particles of an input of which each rank keeps some, its home part, and how they get there and
// from there to other ranks.
//
// The home of a particle follows from its id, or from its number in the whole input: so a particle
// has the same one in each time step, and its places in two steps are known on one rank.

#ifndef HomeParticles_h
#define HomeParticles_h

#include "Agreement.h"
#include "Targets/ParticleShape.h"

#include <cstdint>
#include <functional>
#include <memory>

namespace activesurface
{

// What a shape knows of which this rank has the home part.
struct HomePart
{
  Agreement Ranks;
  // Reads the whole input, with arrays that are not sent home. Collective; null if there are none.
  std::function<std::unique_ptr<InputShape>()> ReadWhole;
};

// Sends the particles of this rank's piece of an input home; returns those whose home it is.
// before, all: points of lower ranks' pieces, and of all. Collective.
ParticleFrame SendHome(
  const Agreement& ranks, ParticleFrame piece, std::uint64_t before, std::uint64_t all);

// All particles of an input, on all ranks: as one process has them. home: this rank's part.
// Collective.
std::shared_ptr<InputShape> GatherShape(const InputShape& home);

}

#endif
