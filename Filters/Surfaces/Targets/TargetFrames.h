// Two consecutive steps of the input at most, and the way between them.

#ifndef TargetFrames_h
#define TargetFrames_h

#include "Targets/InputShape.h"
#include "Targets/ParticleTrack.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace activesurface
{

class TargetFrames
{
public:
  void Clear();

  // The step replaces itself, or else the elder of the two that are held. box: of particles.
  // Parts of shapes on several ranks are not matched.
  void Add(int step, std::shared_ptr<InputShape> shape, const PeriodicBox& box = {});

  // Replaces all by a step and the next one, and their matches.
  void SetPair(int step, std::shared_ptr<InputShape> earlier, std::shared_ptr<InputShape> later,
    ParticleMatches matches)
  {
    this->Earlier = { step, std::move(earlier) };
    this->Later = { step + 1, std::move(later) };
    this->Matches = std::move(matches);
    this->AreMatched = true;
  }

  bool Has(int step) const { return this->Find(step) != nullptr; }

  // That is held; -1 if none is.
  int FindLastStep() const { return this->Later.Shape ? this->Later.Step : -1; }

  // Null if the step is not held.
  InputShape* Find(int step) const;

  // Of the step's shape; no particles and null if it has none.
  const ParticleFrame& GetParticles(int step) const;
  vtkImplicitFunction* GetFunction(int step) const;

  // From a step to the next one, if it is held; as long as no step is added.
  ParticleTrack GetTrack(int step, const PeriodicBox& box, double fraction) const;

  // Matches of the particles of a step and of the next one; null if not both are held, or are not
  // matched.
  const ParticleMatches* FindMatches(int step) const;

  // What a user should know of how the steps were matched; empty if nothing.
  std::string DescribeMatches() const;

private:
  struct Held
  {
    int Step = -1;
    std::shared_ptr<InputShape> Shape;
  };

  Held Earlier, Later;
  bool AreMatched = false;
  ParticleMatches Matches; // of Earlier and Later, if these are consecutive
};

}

#endif
