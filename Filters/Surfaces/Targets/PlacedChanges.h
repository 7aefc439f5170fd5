// Changes between two placements of moving particles.

#ifndef PlacedChanges_h
#define PlacedChanges_h

#include "Targets/ChangedRegion.h"
#include "Targets/ParticleTrack.h"

#include <cstddef>
#include <vector>

namespace activesurface
{

// Box of a particle's support.
ChangedRegion::Box SupportOf(const PlacedParticles& placed, std::size_t i);

// Numbers of particles: in the two placements, and changed between them.
struct PlacedCounts
{
  std::size_t Before = 0;
  std::size_t After = 0;
  std::size_t Changed = 0;
};

class PlacedChanges
{
public:
  // The caller owns both.
  PlacedChanges(const PlacedParticles& then, const PlacedParticles& now);

  PlacedCounts Count() const;

  // Replaces the contents of `supports` by the supports of the changed particles, before and after.
  void ListSupports(std::vector<ChangedRegion::Box>& supports) const;

private:
  // Indices of one particle in the two placements; NoPartner if it is absent.
  struct Pair
  {
    std::size_t Then;
    std::size_t Now;
  };

  void FindPairs();
  std::size_t CountPairs() const;
  Pair PairAt(std::size_t n) const { return this->Pairs.empty() ? Pair{ n, n } : this->Pairs[n]; }
  bool IsSame(const Pair& pair) const;

  const PlacedParticles& Before;
  const PlacedParticles& After;
  std::vector<Pair> Pairs; // empty if both have the same particles
};

}

#endif
