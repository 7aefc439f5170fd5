// So many particles in one place that to look at the neighbours of each would take hours.

#ifndef ParticleCrowd_h
#define ParticleCrowd_h

#include <cstddef>

namespace activesurface
{

// Of fewer particles each may have all as neighbours; else so many on the average, a hundred times
// what is usual, are refused: each is visited for each, so that it would take hours. They are
// counted for a sample.
constexpr std::size_t FewParticles = 30000;
constexpr std::size_t MostNeighbours = 20000;
constexpr std::size_t ParticlesOfSample = 256;
[[noreturn]] void RefuseCrowd(std::size_t particles);

}

#endif
