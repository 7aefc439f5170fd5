// The state of a surface and its way through time, whatever the order in which times are asked for.
//
// The surface goes from one step to the next, so that the states at the steps, the trajectory, do
// not depend on which times between the steps were asked for. A time between two steps is reached
// by a branch, a copy of the earlier step's state, which leaves the trajectory as it is.
//
// A way that was interrupted, by the user or by an error, is taken up again where it was left, at a
// substep. What is between two steps then is no state to branch off: a goal before the next step
// takes the surface back to a checkpoint.
//
// Frames of the target come in from outside, one step after the other:
//
//   simulation.Configure(settings);
//   simulation.SetGoal(time);
//   if (simulation.WantsInitial())
//     simulation.SetInitial(the initial shape);
//   while (simulation.Advance(progress) == SurfaceSimulation::Outcome::NeedsFrame)
//     simulation.AddFrame(step = simulation.GetStepWanted(), the input at that step);
//   simulation.GetBand() is the surface at that time

#ifndef SurfaceSimulation_h
#define SurfaceSimulation_h

#include "Checkpoints.h"
#include "GoalTime.h"
#include "NarrowBand.h"
#include "PassedArrays.h"
#include "StateFile.h"
#include "SurfaceHistory.h"
#include "SurfaceSettings.h"
#include "SurfaceShapes.h"
#include "Warnings.h"

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace activesurface
{

// What the skin shall have besides its shape.
struct SkinWishes
{
  bool Speeds = false;
  bool Arrays = false; // of the particles
  bool Drift = false;  // their velocities
  bool Bound = false;  // the speed of the fastest of them
  std::string Extras;  // with which their frames are to be read for that
};

class SurfaceSimulation
{
public:
  enum class Outcome
  {
    AtGoal,
    NeedsFrame, // of the step GetStepWanted
    Aborted     // by the progress function; the next Advance goes on from there
  };

  // Told, once for each reason and as long as the settings stay the same, what a user should know.
  void SetWarning(const Warnings::Listener& warning) { this->Messages.SetListener(warning); }

  // None of them changes the motion.
  void SetNumberOfThreads(int threads) { this->Threads = threads; }
  void SetMaximumNumberOfActiveVoxels(std::size_t maximum) { this->MaximumVoxels = maximum; }

  // Going back then starts from the last of them.
  void SetCheckpoints(int interval, std::size_t memory) { this->Saved.SetLimits(interval, memory); }

  // Drops everything if these are other settings, unless only further steps have come.
  void Configure(const SurfaceSettings& settings);
  const SurfaceSettings& GetSettings() const { return this->Settings; }

  // What makes the inputs has changed its stamp, but not them.
  void SetTargetStamp(std::uint64_t stamp) { this->Settings.TargetStamp = stamp; }
  void SetInitialStamp(std::uint64_t stamp) { this->Settings.InitialStamp = stamp; }

  // The pipeline time to go to, see FindGoal. One before the state that is held takes the surface
  // back to the nearest checkpoint, or to the start.
  void SetGoal(double pipelineTime);
  double GetGoalTime() const { return this->Goal.Time; }
  int GetGoalStep() const { return this->Goal.Step; } // or the step before

  // The step whose frame has to come next, or -1 if none is needed to reach the goal; and the step
  // that came last, or 0.
  int GetStepWanted() const;
  int GetLastStepAdded() const { return this->LastStepAdded; }
  void AddFrame(int step, TargetFrame frame);

  // Whether the initial shape has to come in before the surface can start.
  bool WantsInitial() const { return this->Shapes.WantsInitial(); }
  void SetInitial(TargetFrame frame) { this->Shapes.SetInitial(std::move(frame)); }

  // Goes as far as the frames allow. Throws std::invalid_argument for settings that cannot be, and
  // what NarrowBand throws: at the start everything then is dropped, later the state is that of the
  // last finished substep.
  Outcome Advance(const ProgressFunction& progress);

  // Forget the state, and the frames.
  void Drop();

  // At the goal, when Advance has reached it.
  const NarrowBand& GetBand() const { return *this->ShareBand(); }
  // To keep: it does not change any more.
  std::shared_ptr<const NarrowBand> ShareBand() const;
  // Whether it is the state at a step, to go on from.
  bool IsAtStep() const { return !this->Goal.Between && !this->Settings.Settles; }

  // What will be asked for at the goal, which needs the target there.
  void SetWishes(const SkinWishes& wishes) { this->Wishes = wishes; }
  const SkinWishes& GetWishes() const { return this->Wishes; }
  // Normal speeds of the skin at the goal, at its vertices.
  std::vector<float> GetSpeeds();
  // The speed of the fastest particle on the way to the goal, see FindLongestWay; 0 where none
  // moves, and for other targets.
  double GetFastestParticle();
  // As wished; refers to the frames.
  PassedArrays GetPassedArrays();

  // The same, or null when the surface is not at the goal.
  const NarrowBand* FindSkin() const;

  // The state at the last step that is not after the goal; its band is null if there is none.
  SavedState GetState() const;

  // From now on, and as long as the settings stay the same after the next Configure, the surface
  // starts with this state.
  void SetState(const SavedState& state);

  // Of the steps up to the goal.
  std::vector<HistoryRow> GetHistory() const;

  // Null as long as the bounds are not known, see SurfaceShapes.
  const SurfaceDomain* FindDomain() { return this->Shapes.FindDomain(); }

  std::size_t GetSubsteps() const { return this->Substeps; }
  std::size_t GetTargetEvaluations() const { return this->TargetEvaluations; }
  void ResetCounters() { this->Substeps = this->TargetEvaluations = 0; }

private:
  bool IsOnStepsOf(const SurfaceSettings& settings) const;
  void ForgetWay();
  void Rewind(int step);
  void TakeLoaded();
  bool HasFramesFrom(int step) const;
  int GetStepWantedAtGoal() const;
  bool LooksBack(bool wantsWay) const;
  bool WantsWay() const;
  void PlaceTargetFrom(int step);
  bool IsUnderWay() const;
  bool BranchIsAtGoal() const;
  ProgressFunction GetPartOf(const ProgressFunction& progress) const;

  bool Start(const ProgressFunction& progress);
  bool StartBand(const SurfaceDomain& domain, const ProgressFunction& progress);
  void KeepWhatIsShared();
  bool AdvanceStep(const ProgressFunction& progress);
  bool AdvanceBranch(const ProgressFunction& progress);
  bool Settle(const ProgressFunction& progress);
  bool AdvanceBand(NarrowBand& band, double time, const ProgressFunction& progress);
  AdvanceReport AdvanceCounting(NarrowBand& band, double time, const ProgressFunction& progress);
  Motion GetMotion();
  void AddToHistory(double pipelineTime, const std::string& event);

  SurfaceSettings Settings;
  int Threads = 0;
  std::size_t MaximumVoxels = 0;
  SkinWishes Wishes;
  Warnings Messages;
  SurfaceShapes Shapes{ this->Settings, this->Messages };
  int LastStepAdded = 0;

  GoalTime Goal;
  int FirstStep = -1;                 // where the way to the goal began, for the progress
  std::shared_ptr<NarrowBand> Band;   // at the step, or under way to the next one
  int Step = -1;                      // -1: not started
  std::shared_ptr<NarrowBand> Branch; // from the step to BranchTime
  double BranchTime = 0.0;            // pipeline time
  bool BranchIsUnderWay = false;      // has not got there
  bool Settled = false;               // has come to rest, or used up its substeps
  std::vector<HistoryRow> History;    // of the farthest way so far
  HistoryWriter Historian;
  Checkpoints Saved;
  SavedState Loaded;
  bool LoadedIsNew = false; // it has been set since the settings were last looked at

  std::size_t Substeps = 0;
  std::size_t TargetEvaluations = 0;
};

}

#endif
