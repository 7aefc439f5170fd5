// What changes from one placement of particles on their way to the next.

#ifndef PlacedChanges_h
#define PlacedChanges_h

#include "Targets/ChangedRegion.h"
#include "Targets/ParticleTrack.h"

#include <cstddef>
#include <vector>

namespace activesurface
{

// The box in which a particle adds something.
ChangedRegion::Box SupportOf(const PlacedParticles& placed, std::size_t i);

// Of particles, in each placement.
struct PlacedCounts
{
  std::size_t Before = 0;
  std::size_t After = 0;
  std::size_t Changed = 0;
};

class PlacedChanges
{
public:
  // Both are the caller's.
  PlacedChanges(const PlacedParticles& then, const PlacedParticles& now);

  PlacedCounts Count() const;

  // Replaces supports by those of what has changed, before and after.
  void ListSupports(std::vector<ChangedRegion::Box>& supports) const;

private:
  // The same particle in both, or NoPartner.
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
  std::vector<Pair> Pairs; // empty where both hold the same ones
};

}

#endif
