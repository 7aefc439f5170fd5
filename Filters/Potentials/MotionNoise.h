// What of the velocities of particles is noise: in a body of fluid, what their neighbours do not
// share.
//
// The mean velocity of the neighbourhood falls to 0 the less it is beside its standard error, the
// spread of the velocities over the root of how many there are (positive-part shrinkage, W. James
// and C. Stein, Berkeley Symposium 1961). The same share of the particle's own velocity is kept, so
// that what is evaluated where few particles reach has no noise either.

#ifndef MotionNoise_h
#define MotionNoise_h

#include "ParticleFit.h"
#include "Skeleton.h"

#include <vector>

namespace activesurface
{

// For each particle, in [0,1]: 1 where no body is in reach. A velocity (x y z each) that is not a
// number is left out of all means. ranks: those that ask for the same together, or null.
// Thread-count independent. Throws as BallCells do.
VTKACTIVEPOTENTIALS_EXPORT std::vector<double> FindSharesOfMotion(
  const std::vector<SkeletonVertex>& particles, const ParticleFits& fits,
  const std::vector<double>& velocities, Agreement* ranks = nullptr);

}

#endif
