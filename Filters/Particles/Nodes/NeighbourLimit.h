// Limit on the number of neighbours of particles.

#ifndef NeighbourLimit_h
#define NeighbourLimit_h

#include <cstddef>

namespace activesurface
{

// Up to FewParticles may all be neighbours of each other. Larger inputs are an error if particles
// have more than MostNeighbours neighbours on average, a hundred times the usual number. Visiting
// all pairs would take hours. The average is that of a sample.
constexpr std::size_t FewParticles = 30000;
constexpr std::size_t MostNeighbours = 20000;
constexpr std::size_t ParticlesOfSample = 256;
[[noreturn]] void RefuseNeighbours(std::size_t particles);

}

#endif
