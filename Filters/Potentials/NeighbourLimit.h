// The number of neighbours from which on particles are refused.

#ifndef NeighbourLimit_h
#define NeighbourLimit_h

#include <cstddef>

namespace activesurface
{

// FewParticles may be neighbours of each other. Among more, MostNeighbours on the average, a
// hundred times the usual number, are refused: each is visited for each, which would take hours.
// Neighbours are counted for a sample.
constexpr std::size_t FewParticles = 30000;
constexpr std::size_t MostNeighbours = 20000;
constexpr std::size_t ParticlesOfSample = 256;
[[noreturn]] void RefuseNeighbours(std::size_t particles);

}

#endif
