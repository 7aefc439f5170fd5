// Runs of particles that follow one another in the order of their blocks.

#ifndef ParticleRuns_h
#define ParticleRuns_h

#include <cstdint>
#include <vector>

namespace activesurface
{

// Columns have this many numbers more than there are particles.
constexpr std::size_t LanePadding = 8;

struct ParticleRun
{
  std::uint32_t First, End;
  float
    Shift[3]; // from the origin of the places that are sought to that of the run's block [voxels]
};

using ParticleRuns = std::vector<ParticleRun>;

}

#endif
