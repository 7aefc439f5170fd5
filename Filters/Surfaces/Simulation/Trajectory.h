// The motion of a surface from step to step, and its branch to a time between two steps.
//
// The trajectory consists of the states at the steps. Requests for times between steps do not
// change the trajectory: for such a time a branch, which is a copy of the earlier step's state,
// moves to this time. An interrupted motion resumes from its last substep. No branch starts from
// the state of an interruption.

#ifndef Trajectory_h
#define Trajectory_h

#include "NarrowBand.h"
#include "Simulation/SurfaceSettings.h"

#include <cstddef>
#include <map>
#include <memory>
#include <string>

namespace activesurface
{

struct BandPart;

// States of a surface at some of its steps, to resume from.
class Checkpoints
{
public:
  // interval: steps between two states; 0 turns checkpoints off. memory: capacity [bytes].
  void SetLimits(int interval, std::size_t memory);

  void Clear() { this->States.clear(); }

  // Saves the state if the step is a multiple of the interval and is not saved yet. While the
  // capacity is exceeded, removes the state that leaves the smallest gap between steps; the first
  // state is removed last.
  void Add(int step, const NarrowBand& band);

  // Saves the state at any step, and replaces an older state at this step. Ignores interval and
  // memory.
  void Keep(int step, const NarrowBand& band);

  // Returns the last saved step <= step, or -1.
  int FindUpTo(int step) const;

  std::unique_ptr<NarrowBand> Restore(int step) const;

private:
  struct Saved
  {
    std::string Bytes;
    std::shared_ptr<const BandPart> Part;
    std::size_t Size; // [bytes]; for a part, an estimate that is equal on all ranks
  };

  static Saved Save(const NarrowBand& band);
  void MakeRoom();
  std::size_t GetSize() const;

  int Interval = 10;
  std::size_t Memory = std::size_t(256) << 20;
  std::map<int, Saved> States; // by step
};

class Trajectory
{
public:
  // Keeps a reference to the settings.
  explicit Trajectory(const SurfaceSettings& settings);

  // Returns to the state before the start.
  void Reset();

  // Sets a step, and the band at this step.
  void Begin(int step, std::unique_ptr<NarrowBand> band);

  bool HasBegun() const { return this->Step >= 0; }
  // Returns the last step that was reached; -1: not started.
  int GetStep() const { return this->Step; }

  // Returns true if the surface has not started, or has not moved from the first step; with
  // EQUILIBRIUM also if the surface has moved.
  bool IsAtStart() const { return this->Step <= 0 && !this->IsUnfinished() && !this->HasBranch(); }

  // Returns true if the motion to the next step was interrupted. A vanished surface without new
  // parts keeps the time of the first step without surface; this is no interruption. Always false
  // with EQUILIBRIUM.
  bool IsUnfinished() const;

  // Returns true if the surface is at the time; with EvolutionMode EQUILIBRIUM, if
  // FinishSteadyState has been called too.
  bool IsAt(const RequestedTime& time) const;
  bool HasBranch() const { return this->Branch != nullptr; }

  // Returns the band to move to the next step: a copy of the present band if an output uses the
  // present band. Discards the branch.
  NarrowBand& GetBandToMove();
  // Has to be called when the band is at the next step.
  void FinishStep() { ++this->Step; }
  // Has to be called in a steady state, or when MaximumSubsteps is reached.
  void FinishSteadyState() { this->IsSteady = true; }

  // Returns the band to move to a time between this step and the next one. A time that differs from
  // that of the branch starts a new branch.
  NarrowBand& GetBranchTo(PipelineTime time);
  void FinishBranch() { this->BranchIsUnfinished = false; }

  // Describes the step, the exact time, the number of active nodes and the presence of a branch.
  std::string Describe() const;

  const NarrowBand& GetBand() const { return *this->Band; }
  // Returns the band at a time for which IsAt() is true. This band is not modified later, so
  // callers may keep it. Null before the first step.
  std::shared_ptr<const NarrowBand> Share(const RequestedTime& time) const;
  std::shared_ptr<const NarrowBand> ShareAtStep() const { return this->Band; }

private:
  bool BranchIsAt(PipelineTime time) const;

  const SurfaceSettings& Settings;
  int Step = -1;
  std::shared_ptr<NarrowBand> Band; // at the step, or interrupted before the next one
  bool IsSteady = false;
  std::shared_ptr<NarrowBand> Branch; // from the step to BranchTime
  PipelineTime BranchTime;
  bool BranchIsUnfinished = false;
};

}

#endif
