// The fits of particles: what each one is among its neighbours, so that the surface of a body
// passes where it should, r outside of its outermost particles.
//
// A lone particle is a ball of its own radius r. In a body, each particle near the surface tells
// where the surface should be: r from it, away from the mean of its neighbours. There the model is
// evaluated, and what it lacks is given to the particle, averaged over the particles of the surface
// nearby: to the own radius (AveragedCentre) or to the strength (Anisotropic, where a strength is
// one over the sum of kernels). A flat layer thus is a plane at r from its outermost particles, a
// box of N particles has a volume of N (2 r)^3 but for what its edges lose.

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
  double OwnRadius = 0.0;    // r [length]; 0: the particle's reach over twice GetReachPerSpacing
  double Anisotropy = 4.0;   // largest ratio of an ellipsoid's axes
  bool SparesCrowds = false; // where there are too many in one place, all fits are as of none
};

// How far neighbours are looked for, in radii.
VTKACTIVEPOTENTIALS_EXPORT double GetNeighbourhoodPerRadius(ParticleModel model);

// One fit for each particle. Thread-count independent. Throws as BallCells do, and
// std::invalid_argument for so many in one place that it would take hours, unless crowds are
// spared.
VTKACTIVEPOTENTIALS_EXPORT ParticleFits FitParticles(
  const FitOptions& options, const std::vector<SkeletonVertex>& particles);

}

#endif
