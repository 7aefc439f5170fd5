// Fits particles to their neighbours, so that the surface of a body passes at distance r outside
// its outermost particles.
//
// An isolated particle is a ball of its own radius r. In a body, each particle near the surface
// gives an expected surface point, at distance r away from the mean of its neighbours. The model is
// evaluated there. The deficiency is averaged over nearby particles of the surface and added to the
// particle. It changes the own radius (AveragedCentre) or the strength (Anisotropic, where a
// strength is one over the sum of kernels). A flat layer is then a plane at distance r from its
// outermost particles. A box of N particles has a volume of N (2 r)^3, except for the volume lost
// at its edges.

#ifndef ParticleFit_h
#define ParticleFit_h

#include "ParticleModel.h"
#include "Skeleton.h"

#include <vector>

namespace activesurface
{

struct FitOptions
{
  ParticleModel Model = ParticleModel::AveragedCentre;
  double OwnRadius = 0.0;    // r [length]; 0: support radius / (2 GetReachPerSpacing)
  double Anisotropy = 4.0;   // largest ratio of an ellipsoid's axes
  bool SparesCrowds = false; // too many coincident particles: default fits, no error
};

// Radius of the neighbourhood, in support radii.
VTKACTIVEPOTENTIALS_EXPORT double GetNeighbourhoodPerRadius(ParticleModel model);

// Returns a fit for each particle. The result does not depend on the number of threads. Throws as
// BallCells do. Throws std::invalid_argument for clusters that would take hours, unless
// SparesCrowds is set.
VTKACTIVEPOTENTIALS_EXPORT ParticleFits FitParticles(
  const FitOptions& options, const std::vector<SkeletonVertex>& particles);

}

#endif
