// Runs of particles that are consecutive in the order of the blocks.

#ifndef ParticleRuns_h
#define ParticleRuns_h

#include <cstddef>
#include <cstdint>
#include <vector>

namespace activesurface
{

// Columns are padded by this number of values.
constexpr std::size_t LanePadding = 8;

struct ParticleRun
{
  std::uint32_t First, End;
  float Shift[3]; // to the origin of the run's block, from the origin that a search uses [voxels]
};

using ParticleRuns = std::vector<ParticleRun>;

}

#endif
