// Lengths of particles.

#ifndef ParticleLengths_h
#define ParticleLengths_h

#include "ParticleModel.h"
#include "Skeleton.h"

#include <vector>

namespace activesurface
{

// The largest of the reaches, and of those of the particles that have a strength > 0.
VTKACTIVEPOTENTIALS_EXPORT double FindLargestRadius(const std::vector<SkeletonVertex>& particles);
VTKACTIVEPOTENTIALS_EXPORT double FindLargestRadiusOfStrengths(
  const std::vector<SkeletonVertex>& particles);

// Within so many reaches of a particle its neighbours are looked for.
double GetNeighbourhoodPerRadius(ParticleModel model);

// How much farther than its own radius the surface is from a particle of a body, for what the edges
// of the body lose.
constexpr double OffsetOfBody = 0.1;

}

#endif
