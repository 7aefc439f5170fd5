// The particles of a way that a rank needs: where it asks at its own places alone, those that reach
// such a place on their way. They keep their order, so that sums over them are the same. What ranks
// share of them comes from where they are at home.

#ifndef NearParticles_h
#define NearParticles_h

#include "Target.h"
#include "Targets/ParticleWay.h"

#include <vector>

namespace activesurface
{

// What is known of a particle in one of the steps; Fit: null without.
struct WayEnd
{
  const SkeletonVertex& Particle;
  const ParticleFit* Fit;
};

class NearParticles
{
public:
  // places: null for all. Rounds of ranks, if what is known of the particles is shared.
  void Choose(const ParticleWay& whole, const OwnPlaces* places);

  // Until they are chosen anew.
  ParticleWay GetWay() const;

  // Whether it is this rank that counts a particle at such origins. Exactly one does.
  bool Counts(const ParticleOrigin& origin) const
  {
    return origin.Earlier != NoPartner ? this->CountsEarlier[origin.Earlier] != 0
                                       : this->CountsLater[origin.Later] != 0;
  }

private:
  struct Candidates;

  void AddEarlier(const ParticleWay& whole, const OwnPlaces* places, const Candidates& candidates);
  void AddBirths(const OwnPlaces* places, const Candidates& candidates);
  // Returns its number among those that are chosen.
  std::size_t AddLater(const WayEnd& end, char isCounted);

  ParticleFrame Earlier;
  ParticleFrame Later;
  ParticleMatches Matches;
  std::vector<double> SharesOfMotion;
  bool HasLater = false;
  bool HasShares = false;
  std::vector<char> CountsEarlier;
  std::vector<char> CountsLater;
};

}

#endif
