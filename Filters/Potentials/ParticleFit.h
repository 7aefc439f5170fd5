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

#include "FitOptions.h"
#include "ParticleModel.h"
#include "Skeleton.h"

#include <vector>

namespace activesurface
{

// What is wanted of a particle, where others are too.
enum class FitNeed : char
{
  Fit,    // all of it
  Bulk,   // and what else its neighbourhood tells by itself
  Shape,  // the same; but what the surface lacks there matters to none of the wanted fits
  Place,  // its place alone: it is a neighbour
  Nothing // it is too far away
};

// A part of many particles.
struct FitPart
{
  std::vector<FitNeed> Needs;      // of those that are here
  double LargestRadius = 0.0;      // of all, by which sums are in the same order
  double LargestOfStrengths = 0.0; // of those that have a strength > 0
};

// One fit for each particle. Thread-count independent. Throws as BallCells do, and
// std::invalid_argument for so many in one place that it would take hours, unless crowds are
// spared. part: of which the particles are, or null if they are all; the fits of those that need
// none are unset, and crowds are taken as they are.
VTKACTIVEPOTENTIALS_EXPORT ParticleFits FitParticles(const FitOptions& options,
  const std::vector<SkeletonVertex>& particles, const FitPart* part = nullptr);

// r of a particle, by its reach.
double GetOwnRadius(const FitOptions& options, double reach);

}

#endif
