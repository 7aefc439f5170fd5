// The fits of the particles of a time step: of all, or on ranks of those that a rank needs.

#ifndef FrameFits_h
#define FrameFits_h

#include "ParticleFit.h"
#include "SomeFits.h"

#include <cstddef>
#include <vector>

namespace activesurface
{

class FrameFits
{
public:
  // Until then nobody wants any: there are none. Where the options have ranks, which all come
  // here, the fits are found when they are asked for. Throws as FitParticles.
  void Want(const FitOptions& options, const std::vector<SkeletonVertex>& particles);

  // Of the next particle, as it was found elsewhere.
  void Add(const ParticleFit& fit);

  bool AreWanted() const { return this->Wanted; }

  // One for each particle; empty if nobody wants them. Ranks ask together, if they are not known.
  const ParticleFits& GetAll(const std::vector<SkeletonVertex>& particles) const;

  // Of some particles, by ascending number. What is found is kept until others are asked for.
  const SomeFits& GetSome(
    const std::vector<SkeletonVertex>& particles, const std::vector<std::size_t>& wanted) const;

  // How far from a particle its fit may count, see SomeFits.h.
  double GetFarthestInfluence(double reach, double largestReach) const;

private:
  FitOptions Options;
  bool Wanted = false;
  bool Crowded = false;
  mutable bool AllKnown = false;
  mutable ParticleFits All;
  mutable SomeFits Some;
};

}

#endif
