// Two consecutive steps of the input at most, and the way between them.

#ifndef TargetFrames_h
#define TargetFrames_h

#include "TargetFrame.h"

#include <cstddef>
#include <vector>

namespace activesurface
{

class TargetFrames
{
public:
  void Clear();

  // The step replaces the elder of the two that are held.
  void Add(int step, TargetFrame frame);

  bool Has(int step) const;
  const TargetFrame& Get(int step) const;
  TargetFrame& Get(int step);

  // The particles of a step, moved on by a fraction in [0,1] of the way to the next one, if that is
  // held. They come in the order of the step, always.
  void InterpolateParticles(int step, double fraction, std::vector<SkeletonVertex>& particles);

private:
  struct Held
  {
    int Step = -1;
    TargetFrame Frame;
  };

  Held Earlier, Later;
  bool Matched = false;
  std::vector<std::size_t> Partners; // in Later, for each particle of Earlier
};

}

#endif
