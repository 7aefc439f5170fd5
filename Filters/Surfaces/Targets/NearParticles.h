// The particles of a way that a rank needs, where it asks at its own places alone: those that reach
// such a place on their way. They keep their order, so that sums over them are the same.

#ifndef NearParticles_h
#define NearParticles_h

#include "Target.h"
#include "Targets/ParticleWay.h"

#include <vector>

namespace activesurface
{

class NearParticles
{
public:
  void Choose(const ParticleWay& whole, const OwnPlaces& places);

  // Until they are chosen anew.
  ParticleWay GetWay() const;

  // Whether it is this rank that counts a particle at such origins. Exactly one does.
  bool Counts(const ParticleOrigin& origin) const
  {
    return origin.Earlier != NoPartner ? this->CountsEarlier[origin.Earlier] != 0
                                       : this->CountsLater[origin.Later] != 0;
  }

private:
  void ChooseEarlier(const ParticleWay& whole, const OwnPlaces& places);
  void ChooseBirths(const ParticleWay& whole, const OwnPlaces& places);
  void AddEarlier(const ParticleFrame& whole, std::size_t i, bool counts);
  // Returns its number among those that are chosen.
  std::size_t AddLater(const ParticleFrame& whole, std::size_t i, bool counts);

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
