// Order of the particles in a frame, independent of the order in the input.
//
// Because of rounding, sums over particles depend on the order. The order in the input is not
// reliable: the order can change if several ranks write the input or send pieces of the input.

#ifndef ParticleOrder_h
#define ParticleOrder_h

#include "Frames/ParticleList.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace activesurface
{

// Returns the indices of the particles in order; empty if they are in order already. Keys: id (if
// ids is not null), x, y, z, radius, strength, index.
std::vector<std::size_t> FindParticleOrder(
  const ParticleList& particles, const std::vector<std::int64_t>* ids);

}

#endif
