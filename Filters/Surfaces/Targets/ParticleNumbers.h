// The places of particles that ranks share in the order of all.

#ifndef ParticleNumbers_h
#define ParticleNumbers_h

#include "Agreement.h"
#include "Targets/ParticleFrame.h"

#include <cstddef>
#include <vector>

namespace activesurface
{

// Of a frame whose particles are in their order (ParticleOrder.h) on each rank: which ones they are
// in the order of the particles of all ranks. Rounds of ranks: a sort by samples, in which each
// rank orders a range of the keys.
std::vector<std::size_t> FindParticleNumbers(Agreement& ranks, const ParticleFrame& frame);

}

#endif
