// The surface on its way from step to step, and its branch to a time between two steps.
//
// The states at the steps, the trajectory, do not depend on which times between them were asked
// for: such a time is reached by a branch, a copy of the earlier step's state. A way that was
// interrupted goes on from the substep where it was left. What lies between two steps then is no
// state to branch off.

#ifndef Trajectory_h
#define Trajectory_h

#include "NarrowBand.h"
#include "Simulation/SurfaceSettings.h"

#include <memory>
#include <string>

namespace activesurface
{

class Trajectory
{
public:
  // The settings are the caller's.
  explicit Trajectory(const SurfaceSettings& settings);

  // Not started.
  void Reset();

  // The surface is at a step, with this band.
  void Begin(int step, std::unique_ptr<NarrowBand> band);

  bool HasBegun() const { return this->Step >= 0; }
  // The step, or the one before where it is under way; -1: not started.
  int GetStep() const { return this->Step; }

  // Whether it has gone nowhere yet.
  bool IsAtStart() const { return this->Step <= 0 && !this->IsUnderWay() && !this->HasBranch(); }

  // Whether it has been interrupted on its way to the next step. A surface that has vanished stays
  // at the time at which it did.
  bool IsUnderWay() const;

  // Whether it has begun and is there; a surface that goes to its steady state has to be told by
  // FinishSteadyState.
  bool IsAt(const RequestedTime& time) const;
  bool HasBranch() const { return this->Branch != nullptr; }

  // The band to be moved on from the step; a copy while an output, at another port or elsewhere,
  // holds it.
  NarrowBand& GetBandToMove();
  // It has got to the next step.
  void FinishStep() { ++this->Step; }
  // It has come to rest, or used up its substeps.
  void FinishSteadyState() { this->IsSteady = true; }

  // The band to be moved to a time between this step and the next; begun anew for another time.
  NarrowBand& GetBranchTo(PipelineTime time);
  void FinishBranch() { this->BranchIsUnderWay = false; }

  // Where it is, to the last bit of the time.
  std::string Describe() const;

  const NarrowBand& GetBand() const { return *this->Band; }
  // To keep, at a time where it is: it does not change any more. Null before the first step.
  std::shared_ptr<const NarrowBand> Share(const RequestedTime& time) const;
  std::shared_ptr<const NarrowBand> ShareAtStep() const { return this->Band; }

private:
  bool BranchIsAt(PipelineTime time) const;

  const SurfaceSettings& Settings;
  int Step = -1;
  std::shared_ptr<NarrowBand> Band; // at the step, or under way to the next one
  bool IsSteady = false;
  std::shared_ptr<NarrowBand> Branch; // from the step to BranchTime
  PipelineTime BranchTime;
  bool BranchIsUnderWay = false;
};

}

#endif
