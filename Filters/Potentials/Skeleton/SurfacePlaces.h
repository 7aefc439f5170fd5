// What a particle's neighbourhood tells: whether it is in a body, how it is shaped, and where the
// surface beside it should be.

#ifndef SurfacePlaces_h
#define SurfacePlaces_h

#include "ParticleModel.h"
#include "Skeleton.h"
#include "Skeleton/NeighbourSums.h"

namespace activesurface
{

// Where the surface should be, and how much each place counts.
struct SurfacePlaces
{
  double Away[3]; // from the mean of the neighbours, which counts at the edge of a body
  double Deep;
  double Across[3]; // of a sheet or a thread
  double Thin;
  double ShapeShare; // of what the neighbours lack, in place of the particle's own lack

  bool AreOfSurface() const { return this->Deep > 0.0 || this->Thin > 0.0; }
};

struct NeighbourhoodOptions
{
  ParticleModel Model;
  double Anisotropy; // largest ratio of axes
  double Reach;      // of the neighbourhood [length]
  double OwnRadius;  // of the particle [length]
};

// Sets the fit but for what the particle's neighbours share with it, and the places. sums: around
// the particle.
void FitNeighbourhood(const NeighbourhoodOptions& options, const SkeletonVertex& particle,
  const NeighbourMoments& sums, ParticleFit& fit, SurfacePlaces& places);

}

#endif
