// Distributed particles of an input. Each rank owns some of the particles, its owned part.
//
// The owner of a particle follows from its id, or from its index in the whole input. A particle
// that is matched between two steps therefore has the same owner in these steps, and the owner has
// both positions.

#ifndef OwnedParticles_h
#define OwnedParticles_h

#include "Ranks/Agreement.h"
#include "Targets/ParticleShape.h"

#include <cstdint>
#include <functional>
#include <memory>

namespace activesurface
{

// Data of a shape that has only a part of the input's particles, see InputShape::Owned.
struct OwnedPart
{
  Agreement Ranks;
  // Reads the whole input, including arrays that are not sent to the owners; null if there are no
  // such arrays. Collective.
  std::function<std::unique_ptr<InputShape>()> ReadWhole;
};

// Sends the particles of this rank's piece to their owners, and returns the particles that this
// rank owns. before: number of points in the pieces of lower ranks. all: number of points in all
// pieces. Collective.
ParticleFrame SendToOwners(
  const Agreement& ranks, ParticleFrame piece, std::uint64_t before, std::uint64_t all);

// Returns all particles of an input on each rank, as a single process would read the particles.
// owned: the particles that this rank owns. Collective.
std::shared_ptr<InputShape> GatherShape(const InputShape& owned);

}

#endif
