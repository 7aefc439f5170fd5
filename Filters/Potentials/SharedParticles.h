// Particles that ranks share: each rank has some of them.

#ifndef SharedParticles_h
#define SharedParticles_h

#include "ParticleHomes.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace activesurface
{

struct SharedParticles
{
  Agreement& Ranks;
  std::size_t CountOfAll = 0;

  // Of the particles that this rank has their places in the order of all, ascending.
  std::vector<std::size_t> Numbers;

  // Which of them are on which rank; null as long as each has those of its piece of the input.
  std::shared_ptr<const ParticleHomes> Homes;

  // Of the particles of all ranks, once they are at home: the box of their supports (xmin xmax ymin
  // ymax zmin zmax), the largest radius, and that of those of a strength > 0.
  double Bounds[6] = {};
  double LargestRadius = 0.0;
  double LargestRadiusOfActive = 0.0;
};

}

#endif
