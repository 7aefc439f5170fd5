// The particles of a way that a rank needs, where ranks share them: those that reach its own places
// on their way. They keep their order, so that sums over them are the same. They come from where
// they are at home: there it is known how far each reaches.

#ifndef NearParticles_h
#define NearParticles_h

#include "Target.h"
#include "Targets/ParticleWay.h"

#include <vector>

namespace activesurface
{

struct ParticleParcels;

class NearParticles
{
public:
  // Ranks share the way. places: null for all particles. Rounds of ranks.
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
  void MakeRoom(const ParticleParcels& parcels);
  void Add(const ParticleParcels& parcels, std::size_t n, const OwnPlaces* places);

  ParticleFrame Earlier;
  ParticleFrame Later;
  ParticleMatches Matches;
  bool HasLater = false;
  std::vector<char> CountsEarlier;
  std::vector<char> CountsLater;
};

}

#endif
