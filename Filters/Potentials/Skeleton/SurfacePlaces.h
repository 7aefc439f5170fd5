// Derives from a particle's neighbourhood whether it is in a body, its shape, and the expected
// position of the surface.

#ifndef SurfacePlaces_h
#define SurfacePlaces_h

#include "ParticleModel.h"
#include "Skeleton.h"
#include "Skeleton/NeighbourSums.h"

namespace activesurface
{

// Expected points of the surface and their weights.
struct SurfacePlaces
{
  double Away[3]; // away from the neighbours' mean, at the edge of a body; weight Deep
  double Deep;
  double Across[3]; // along the thinnest axis of a sheet or a thread; weight Thin
  double Thin;
  double ShapeShare; // weight of the neighbours' deficiency against the particle's own

  bool AreOfSurface() const { return this->Deep > 0.0 || this->Thin > 0.0; }
};

struct NeighbourhoodOptions
{
  ParticleModel Model;
  double Anisotropy; // largest ratio of axes
  double Reach;      // of the neighbourhood [length]
  double OwnRadius;  // of the particle [length]
};

// Sets the fit, except the deficiency that neighbours share, and the places. sums: around the
// particle.
void FitNeighbourhood(const NeighbourhoodOptions& options, const SkeletonVertex& particle,
  const NeighbourMoments& sums, ParticleFit& fit, SurfacePlaces& places);

}

#endif
