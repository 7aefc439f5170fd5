// Particles of a frame as bytes that ranks send each other; nothing is rounded.

#ifndef ParticleBytes_h
#define ParticleBytes_h

#include "Communicator.h"
#include "Targets/ParticleFrame.h"

#include <cstdint>
#include <vector>

namespace activesurface
{

using ParticleChoice = std::vector<std::uint32_t>; // numbers of particles in a frame

// The chosen particles, with ids and velocities; without radii and passed arrays.
Bytes PackParticles(const ParticleFrame& frame, const ParticleChoice& chosen);

// Particles of several ranks in one frame, in its order. like: a frame that says whether there are
// ids, and what radius all have.
ParticleFrame MergeParticles(const std::vector<Bytes>& parts, const ParticleFrame& like);

}

#endif
