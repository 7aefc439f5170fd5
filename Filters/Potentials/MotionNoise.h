// What of the velocities of particles is noise: in a body of fluid, what their neighbours do not
// share.
//
// The mean velocity of the neighbourhood falls to 0 the less it is beside its standard error, the
// spread of the velocities over the root of how many there are (positive-part shrinkage, W. James
// and C. Stein, Berkeley Symposium 1961). The same share of the particle's own velocity is kept, so
// that what is evaluated where few particles reach has no noise either.

#ifndef MotionNoise_h
#define MotionNoise_h

#include "LocalParticles.h"
#include "ParticleModel.h"

#include <vector>

namespace activesurface
{

// Neighbours are those within so many radii.
constexpr double MotionNeighbourhoodPerRadius = 1.0;

// For each particle at home, in [0,1]: 1 where no body is in reach. fits, velocities: of these;
// velocities x y z each, of which one that is not a number is left out of all means.
// Thread-count independent. Throws as BallCells do. A round of ranks.
VTKACTIVEPOTENTIALS_EXPORT std::vector<double> FindSharesOfMotion(
  const LocalParticles& near, const ParticleFits& fits, const std::vector<double>& velocities);

}

#endif
