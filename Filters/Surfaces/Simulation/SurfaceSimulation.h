// A surface through time, whatever the order in which times are requested.
//
//   simulation.Configure(settings);
//   simulation.Request(time, arrays);
//   if (simulation.WantsInitial())
//     simulation.SetInitial(the initial shape);
//   simulation.Advance(frames, progress); // asks frames(step) for the target at the steps it needs
//   simulation.GetBand() is the surface at that time
//
// A motion that was interrupted, by the user or by an error, is taken up again by the next Advance.
// A request for an earlier time takes the surface back to a checkpoint.

#ifndef SurfaceSimulation_h
#define SurfaceSimulation_h

#include "Simulation/ArrayFrames.h"
#include "Simulation/BoxView.h"
#include "Simulation/Checkpoints.h"
#include "Simulation/MotionDriver.h"
#include "Simulation/RestartWarning.h"
#include "Simulation/SharedFrames.h"
#include "Simulation/SkinAttributes.h"
#include "Simulation/StateFile.h"
#include "Simulation/SurfaceHistory.h"
#include "Simulation/SurfaceSettings.h"
#include "Simulation/TargetBuilder.h"
#include "Simulation/TargetCoverage.h"
#include "Simulation/Trajectory.h"
#include "Simulation/ValuesInUse.h"
#include "Simulation/Warnings.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace activesurface
{

// None of them changes the motion.
struct SimulationLimits
{
  int Threads = 0;
  std::size_t MaximumVoxels = 0;
  int CheckpointInterval = 1;
  std::size_t CheckpointMemory = 0; // bytes
};

class SurfaceSimulation
{
public:
  using FrameSource = std::function<std::shared_ptr<InputShape>(int step)>;

  // Told, once for each reason and as long as the settings stay the same, what a user should know.
  void SetWarning(const Warnings::Listener& warning) { this->Messages.SetListener(warning); }
  void SetLimits(const SimulationLimits& limits);
  // Resets everything if these are other settings, unless only further steps have come.
  void Configure(const SurfaceSettings& settings);
  const SurfaceSettings& GetSettings() const { return this->Settings; }
  // Whether a motion that has begun goes on with them.
  bool HasBegun() const { return this->Way.HasBegun(); }
  bool IsContinuedBy(const SurfaceSettings& settings) const
  {
    return this->HasBegun() && (this->Settings == settings || this->IsLengthenedBy(settings));
  }

  // Withdraws the last step, unless its frame has come in; false: it stays.
  bool WithdrawLastStep()
  {
    const int last = this->Settings.GetNumberOfSteps() - 1;
    const bool isNext = last > 0 && this->Way.GetStep() == last - 1 && !this->Shapes.Has(last);
    return isNext && this->Settings.Inputs.WithdrawStep();
  }

  // What makes the inputs has changed its MTime, but not them.
  void SetTargetMTime(std::uint64_t time) { this->Settings.Inputs.TargetMTime = time; }
  void SetInitialMTime(std::uint64_t time) { this->Settings.Inputs.InitialMTime = time; }

  // The time to go to, and what the skin shall have there.
  void Request(PipelineTime time, const RequestedArrays& arrays);
  const RequestedTime& GetRequestedTime() const { return this->Requested; }
  const RequestedArrays& GetRequestedArrays() const { return this->Arrays; }

  // The step whose frame is needed first to get there, or -1 if none is; and the step that came
  // last, or 0.
  int FindMissingStep() const;
  int GetLastStepAdded() const { return this->LastStepAdded; }
  void AddFrame(int step, std::shared_ptr<InputShape> shape);
  // Returns true if ranks, where there are several, each keep a part of the frames that come next.
  bool SharesSpace() const
  {
    return this->Settings.CanShareSpace() && this->Shapes.FindSpacing() > 0.0;
  }

  // Where the surface is and which frames it will ask for: the same text on all ranks of a parallel
  // program as long as they keep step.
  std::string DescribeState() const
  {
    return this->Way.Describe() + ", needs " + std::to_string(this->FindMissingStep()) +
      ", after " + std::to_string(this->LastStepAdded) + (this->WantsInitial() ? ", initial" : "") +
      (this->Loaded.Band ? ", loaded" : "");
  }

  // Before the first frame, see TargetBuilder.
  bool WantsSpacing() const { return this->Shapes.WantsSpacing() && this->FindMissingStep() == 0; }
  std::vector<int> ListSpacingSteps() const { return this->Shapes.ListSpacingSteps(); }
  TargetBuilder::SpacingSample SampleSpacing(const InputShape& shape) const
  {
    return TargetBuilder::SampleSpacing(shape, this->Shapes.GetBox());
  }
  void SettleSpacing(const std::vector<TargetBuilder::SpacingSample>& samples)
  {
    this->Shapes.SettleSpacing(samples);
  }

  // Whether the initial shape has to come in before the surface can start.
  bool WantsInitial() const { return this->Shapes.WantsInitial(); }
  void SetInitial(std::shared_ptr<InputShape> shape) { this->Shapes.SetInitial(std::move(shape)); }

  // To the requested time; false if `progress` has stopped it. Throws std::invalid_argument for
  // settings that cannot be, and what NarrowBand and `frames` throw: at the start everything then
  // is reset, later the state is that of the last finished substep.
  bool Advance(const FrameSource& frames, const ProgressFunction& progress);

  // Forgets the state, and the frames.
  void Reset();

  // The surface, when Advance has reached the requested time.
  // This rank's part of it, or all if what was requested needs that.
  const NarrowBand& GetBand() const { return *this->ShareBand(); }
  // World position of the band's node (0, 0, 0), which the band's positions are relative to.
  const std::array<double, 3>& GetOrigin() const { return this->Shapes.GetOrigin(); }
  // To keep: it does not change any more.
  std::shared_ptr<const NarrowBand> ShareBand() const
  {
    return this->ViewOf(this->ShareWholeBand());
  }
  // The state, which in a periodic box extends beyond the sides.
  std::shared_ptr<const NarrowBand> ShareWholeBand() const
  {
    return this->Whole ? this->Whole : this->Way.Share(this->Requested);
  }
  // Whether it is the state at a step, to go on from.
  bool IsAtStep() const { return !this->Requested.Between && !this->Settings.IsEquilibrium(); }
  // Null when the surface is not at the requested time.
  const NarrowBand* FindSkin() const
  {
    return this->Way.IsAt(this->Requested) ? &this->GetBand() : nullptr;
  }
  // The same of an earlier request.
  const NarrowBand* FindSkinAt(const RequestedTime& time) const
  {
    const bool isWhole = this->Whole && time.Time == this->Requested.Time;
    return !this->Way.IsAt(time) ? nullptr
      : isWhole                  ? this->Whole.get()
                                 : this->ViewOf(this->Way.Share(time)).get();
  }

  // Warns a user once for each reason.
  void Warn(const std::string& reason, const std::string& sentence) const
  {
    this->Messages.Say(reason, sentence);
  }

  // What the skin has there besides its shape: its motion, and what FindAttributes tells.
  SkinAttributes FindAttributes() const
  {
    return { this->Settings, this->Shapes, this->Messages, this->Requested, this->Arrays };
  }
  // Of the skin that was requested.
  Motion GetMotion() const;
  // On the last way to it; before that on the first way, as soon as the inputs are read.
  ValuesInUse GetValuesInUse() const
  {
    const int from = this->Requested.Step - (this->Requested.Between ? 0 : 1);
    return this->FindSkin() || this->Shapes.GetDomain()
      ? FindValuesInUse(this->Driver.GetMotion(std::max(from, 0)), this->Shapes)
      : ValuesInUse();
  }

  // The state at the last step that is not after the requested time; its band is null if there is
  // none, as with EvolutionMode EQUILIBRIUM.
  SavedState GetState() const;
  // Gathers the state of all ranks on the first one; others get no band. Collective.
  SavedState GatherState() const;
  // From now on, and as long as the settings stay the same after the next Configure, the surface
  // starts with this state.
  void SetState(const SavedState& state);

  // Of the steps up to the requested time.
  std::vector<HistoryRow> GetHistory() const;

  // Null as long as the bounds are not known, see TargetBuilder.
  const SurfaceDomain* FindDomain() { return this->Shapes.FindDomain(); }

  const MotionDriver& GetDriver() const { return this->Driver; }
  void ResetCounters() { this->Driver.ResetCounters(); }

private:
  // Whether further steps have come, and the way so far is one along these. An input of one step
  // stands still, and the filter has its own clock as long as it does.
  bool IsLengthenedBy(const SurfaceSettings& settings) const
  {
    const bool isOnSteps =
      this->Settings.Inputs.TargetMoves ? settings.Inputs.TargetMoves : this->Way.IsAtStart();
    return isOnSteps && this->Settings.AreContinuedBy(settings);
  }
  void ResetTrajectory();
  void Rewind(int step);
  void RestoreLoaded();
  bool HasFramesFrom(int step) const;
  ArrayFrames FindArrayFrames() const
  {
    return activesurface::FindArrayFrames(this->Settings, this->Requested, this->Arrays,
      this->Shapes, WantWay(this->Arrays, this->Shapes));
  }
  int FindMissingStepOfArrays() const;
  void PrepareOutputs();
  ProgressFunction GetPartOf(const ProgressFunction& progress) const;

  bool AdvanceLeg(const ProgressFunction& progress);
  bool Start(const ProgressFunction& progress);
  bool StartBand(const ProgressFunction& progress);
  bool AdvanceStep(const ProgressFunction& progress);
  bool AdvanceToSteadyState(const ProgressFunction& progress);
  bool AdvanceBranch(const ProgressFunction& progress);
  void Record(std::size_t row, PipelineTime time, const std::string& event);
  // The part of a surface that outputs show.
  std::shared_ptr<const NarrowBand> ViewOf(const std::shared_ptr<const NarrowBand>& band) const
  {
    return band && this->Shapes.GetBox().Any() ? this->View.Cut(band, this->Driver.MakeWalls(0.0))
                                               : band;
  }
  // Whether the share outside has not fallen; it falls while a skin that starts elsewhere
  // approaches the target.
  bool Loses(std::size_t row, double outside) const
  {
    const double atStart = this->Settings.StartsElsewhere() ? 1.0 : 0.0;
    return !(outside < (row > 0 ? this->History.GetOutside(row - 1) : atStart));
  }

  SurfaceSettings Settings;
  Warnings Messages;
  RestartWarning Restarts;
  TargetBuilder Shapes{ this->Settings, this->Messages };
  SharedFrames Shared{ this->Shapes };
  MotionDriver Driver{ this->Settings, this->Shapes, this->Messages };
  int LastStepAdded = 0;
  int Unverified = -1; // a step to be read again, as the source has changed while it got more steps

  RequestedTime Requested;
  RequestedArrays Arrays;
  int FirstStep = -1; // where the way to the requested time began, for the progress

  Trajectory Way{ this->Settings };
  mutable BoxView View;
  std::shared_ptr<const NarrowBand> Whole; // of ranks that share out space, if outputs need it
  Checkpoints Saved;
  HistoryRecorder History;
  TargetCoverage Coverage{ this->Settings, this->Shapes };
  SavedState Loaded;
  bool LoadedIsNew = false; // it has been set since the last Configure
};

}

#endif
