// Runs of particles that follow one another in the order of their blocks.

#ifndef ParticleRuns_h
#define ParticleRuns_h

#include <cstddef>
#include <cstdint>
#include <vector>

namespace activesurface
{

// Columns have this many numbers more than there are particles.
constexpr std::size_t LanePadding = 8;

struct ParticleRun
{
  std::uint32_t First, End;
  float Shift[3]; // to the origin of the run's block, from the origin that a search uses [voxels]
};

using ParticleRuns = std::vector<ParticleRun>;

}

#endif
