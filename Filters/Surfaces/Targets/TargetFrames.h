// Two consecutive steps of the input at most, and the way between them.

#ifndef TargetFrames_h
#define TargetFrames_h

#include "Targets/InputShape.h"
#include "Targets/ParticleMatches.h"

#include <memory>
#include <vector>

namespace activesurface
{

class TargetFrames
{
public:
  void Clear();

  // The step replaces itself, or else the elder of the two that are held.
  void Add(int step, std::shared_ptr<InputShape> shape);

  bool Has(int step) const { return this->Find(step) != nullptr; }

  // Null if the step is not held.
  InputShape* Find(int step) const;

  // Of the step's shape; no particles and null if it has none.
  const ParticleFrame& GetParticles(int step) const;
  vtkImplicitFunction* GetFunction(int step) const;

  // The particles at a fraction in [0,1] of the way from a step to the next one, see
  // ParticleMatches.h; those of the step itself, in their order, at 0 and as long as the next one
  // is not held.
  void PlaceParticles(int step, double fraction, std::vector<SkeletonVertex>& particles) const;

  // Of the particles of a step and those of the next one; null if not both are held.
  const ParticleMatches* FindMatches(int step) const;

private:
  struct Held
  {
    int Step = -1;
    std::shared_ptr<InputShape> Shape;
  };

  Held Earlier, Later;
  ParticleMatches Matches; // of Earlier and Later, if these are consecutive
};

}

#endif
