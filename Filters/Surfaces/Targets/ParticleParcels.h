// What ranks tell each other of particles on their way: who has one at home tells those whose
// places it reaches.

#ifndef ParticleParcels_h
#define ParticleParcels_h

#include "Target.h"
#include "Targets/ParticleWay.h"

#include <cstddef>
#include <vector>

namespace activesurface
{

// A particle at the ends of its way.
struct ParticleParcel
{
  std::size_t Number; // of the earlier one in the order of all; of a birth, of the later one
  bool HasEarlier;    // else it is born
  bool HasLater;      // else it dies, or the way has no next step
  SkeletonVertex Earlier;
  SkeletonVertex Later;
};

// Those that reach a rank's places.
struct ParticleParcels
{
  std::vector<ParticleParcel> Parcels;
  std::vector<std::size_t> Order; // of the parcels, as of all: the earlier ones, then the births
  std::vector<ParticleFit> Fits;  // of each at its ends, so many; or empty
  std::size_t FitsOfEach = 0;
};

// Ranks share the way, whose particles are at home. places: null if all are wanted by all. Rounds
// of ranks.
ParticleParcels SendParcels(const ParticleWay& way, const OwnPlaces* places);

}

#endif
