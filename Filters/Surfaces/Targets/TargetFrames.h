// Two consecutive steps of the input at most, and the way between them.

#ifndef TargetFrames_h
#define TargetFrames_h

#include "Targets/ParticleMatches.h"
#include "Targets/TargetFrame.h"

#include <vector>

namespace activesurface
{

class TargetFrames
{
public:
  void Clear();

  // The step replaces itself, or else the elder of the two that are held.
  void Add(int step, TargetFrame frame);

  bool Has(int step) const;
  const TargetFrame& Get(int step) const;
  TargetFrame& Get(int step);

  // The particles at a fraction in [0,1] of the way from a step to the next one, see
  // ParticleMatches.h; those of the step itself, in their order, at 0 and as long as the next one
  // is not held.
  void PlaceParticles(int step, double fraction, std::vector<SkeletonVertex>& particles);

  // Of the particles of a step and those of the next one; null if not both are held.
  const ParticleMatches* FindMatches(int step);

private:
  struct Held
  {
    int Step = -1;
    TargetFrame Frame;
  };

  Held Earlier, Later;
  bool Matched = false;
  ParticleMatches Matches; // of Earlier and Later
};

}

#endif
