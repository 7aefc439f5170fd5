// At most two steps of the input, usually consecutive, and the particle motion between them.

#ifndef TargetFrames_h
#define TargetFrames_h

#include "ParticleTrack.h"
#include "Targets/InputShape.h"

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

  // Adds a step. Replaces the shape of a step that is stored already; otherwise keeps only
  // FindLastStep() of the stored steps. box: periodic box of the particles. Particles of
  // distributed shapes are not matched.
  void Add(int step, std::shared_ptr<InputShape> shape, const PeriodicBox& box = {});

  // Replaces the stored steps by a step and the next one, with their matches.
  void SetPair(int step, std::shared_ptr<InputShape> earlier, std::shared_ptr<InputShape> later,
    ParticleMatches matches)
  {
    this->Earlier = { step, std::move(earlier) };
    this->Later = { step + 1, std::move(later) };
    this->Matches = std::make_shared<ParticleMatches>(std::move(matches));
  }

  bool Has(int step) const { return this->Find(step) != nullptr; }

  // Returns the step added last, or the higher of two consecutive steps; -1 without steps.
  int FindLastStep() const { return this->Later.Shape ? this->Later.Step : -1; }

  // Returns the shape of a step; null if the step is not stored.
  InputShape* Find(int step) const;

  // Return the particles, the function or the label of a step's shape. Without particles,
  // GetParticles returns an empty frame; the other functions return null without a function or
  // label.
  const ParticleFrame& GetParticles(int step) const;
  vtkImplicitFunction* GetFunction(int step) const;
  const LabelFacts* GetLabel(int step) const;

  // Returns the track from a step to the next one; without matches of these steps, a track that
  // stays at the step. Valid until a step is added.
  ParticleTrack GetTrack(int step, const PeriodicBox& box, double fraction) const;
  // Returns the track from the step after `step` back to `step`, at the beginning of this track.
  ParticleTrack GetTrackBack(int step, const PeriodicBox& box) const;

  // Returns the particle matches of a step and the next one; null if a step is not stored, or if
  // the steps are not matched.
  std::shared_ptr<const ParticleMatches> FindMatches(int step) const;

  // Returns a message about the matching; empty if there is none.
  std::string DescribeMatches() const;

private:
  struct Held
  {
    int Step = -1;
    std::shared_ptr<InputShape> Shape;
  };

  Held Earlier, Later;
  std::shared_ptr<const ParticleMatches> Matches; // of Earlier and Later; null: not matched
};

}

#endif
