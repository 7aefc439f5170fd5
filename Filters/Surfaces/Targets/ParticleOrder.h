// The order of particles in a frame, which does not depend on how the input lists them.
//
// What is summed over particles is rounded, and so depends on their order. An input that was
// written by several ranks, or passed on by them in pieces, has the same particles in another
// order.

#ifndef ParticleOrder_h
#define ParticleOrder_h

#include "Targets/ParticleList.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace activesurface
{

// Which particle comes first, second, ... By id if there are ids, else (null) by place: x, y, z,
// radius, strength. Equal ones stay in their order. Empty if all are in order.
std::vector<std::size_t> FindParticleOrder(
  const ParticleList& particles, const std::vector<std::int64_t>* ids);

}

#endif
