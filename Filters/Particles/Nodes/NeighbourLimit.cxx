#include "Nodes/NeighbourLimit.h"

#include <stdexcept>
#include <string>

namespace activesurface
{

void RefuseNeighbours(std::size_t particles)
{
  throw std::invalid_argument("The " + std::to_string(particles) + " particles have more than " +
    std::to_string(MostNeighbours) +
    " neighbours in reach on the average, where some 200 are usual; check whether many are in the "
    "same place, and whether ParticleSpacing and KernelRadius (or the array of radii) are in the "
    "particles' own units, or set ParticleModel to SUM.");
}

}
