// A surface over time; times may be requested in any order.
//
//   simulation.Configure(settings);
//   simulation.Request(time, arrays);
//   if (simulation.WantsInitial())
//     simulation.SetInitial(the initial shape);
//   simulation.Advance(frames, progress); // asks frames(step) for the target at the steps it needs
//   simulation.GetBand() is the surface at that time
//
// The next Advance continues a motion that the user or an error has interrupted. A request for an
// earlier time restores a checkpoint or, without a checkpoint, restarts the motion.

#ifndef SurfaceSimulation_h
#define SurfaceSimulation_h

#include "Base/Walls.h"
#include "NarrowBand.h"
#include "Simulation/MotionDriver.h"
#include "Simulation/MotionWarnings.h"
#include "Simulation/SharedFrames.h"
#include "Simulation/SkinAttributes.h"
#include "Simulation/StateFile.h"
#include "Simulation/SurfaceHistory.h"
#include "Simulation/SurfaceSettings.h"
#include "Simulation/TargetBuilder.h"
#include "Simulation/TargetCoverage.h"
#include "Simulation/Trajectory.h"
#include "Targets/Warnings.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace activesurface
{

// The part of a surface within the sides of a periodic box, for the outputs. The state itself
// extends beyond the sides, so that the surface can enter the box from outside.
class BoxView
{
public:
  void Clear() { this->Last = {}; }

  // Returns the part within the sides, closed at the sides. Caches the parts of the last two
  // surfaces: the same surface yields the same object.
  std::shared_ptr<const NarrowBand> Cut(
    const std::shared_ptr<const NarrowBand>& whole, const Walls& sides)
  {
    for (const Entry& entry : this->Last)
    {
      if (entry.Whole == whole)
      {
        return entry.Part;
      }
    }
    std::shared_ptr<const NarrowBand> part = whole->MakePartWithin(sides);
    this->Last = { Entry{ whole, part }, this->Last[0] };
    return part;
  }

private:
  struct Entry
  {
    std::shared_ptr<const NarrowBand> Whole, Part;
  };
  std::array<Entry, 2> Last;
};

// Limits that do not change the motion.
struct SimulationLimits
{
  int Threads = 0;
  std::size_t MaximumVoxels = 0;
  int CheckpointInterval = 1;
  std::size_t CheckpointMemory = 0; // MiB
};

class SurfaceSimulation
{
public:
  using FrameSource = std::function<std::shared_ptr<InputShape>(int step)>;

  // Sets the listener for warnings and notes. Each reason (Warnings.h) is reported once, and again
  // after a change of the settings.
  void SetWarning(const Warnings::Listener& warning) { this->Messages.SetListener(warning); }
  void SetLimits(const SimulationLimits& limits);
  // Resets the simulation if the settings have changed, unless IsLengthenedBy(settings). Keeps a
  // state loaded since the last call.
  void Configure(const SurfaceSettings& settings);
  const SurfaceSettings& GetSettings() const { return this->Settings; }
  bool HasBegun() const { return this->Path.HasBegun(); }
  // Returns the times of a loaded state's history; the last time is that of the state. Empty
  // without a loaded state, and after the surface has started.
  std::vector<double> ListTimesToResume() const;
  // Returns true if a motion that has begun continues with these settings.
  bool IsContinuedBy(const SurfaceSettings& settings) const
  {
    return this->HasBegun() && (this->Settings == settings || this->IsLengthenedBy(settings));
  }

  // Removes the last step and returns true if the surface is at the step before and the frame of
  // the last step is not stored. Otherwise returns false.
  bool WithdrawLastStep()
  {
    const int last = this->Settings.GetNumberOfSteps() - 1;
    const bool isNext = last > 0 && this->Path.GetStep() == last - 1 && !this->Shapes.Has(last);
    return isNext && this->Settings.Inputs.WithdrawStep();
  }

  // Sets the MTime of an input's pipeline without a restart, as the input's data have not changed.
  void SetTargetMTime(std::uint64_t time) { this->Settings.Inputs.TargetMTime = time; }
  void SetInitialMTime(std::uint64_t time) { this->Settings.Inputs.InitialMTime = time; }

  // Sets the time for Advance, and the arrays of the skin at this time.
  void Request(PipelineTime time, const RequestedArrays& arrays);
  const RequestedTime& GetRequestedTime() const { return this->Requested; }
  const RequestedArrays& GetRequestedArrays() const { return this->Arrays; }

  // Returns the step of the next frame that Advance needs, or -1.
  int FindMissingStep() const;
  // Returns the step added last, or 0.
  int GetLastStepAdded() const { return this->LastStepAdded; }
  void AddFrame(int step, std::shared_ptr<InputShape> shape);
  // Returns true if each rank, where there are several, needs only a part of the next frames.
  bool SharesSpace() const
  {
    return this->Settings.CanShareSpace() && this->Shapes.FindSpacing() > 0.0;
  }

  // Describes the time of the surface and the frames that the surface needs. Ranks compare this
  // text, which is the same on all ranks while their states agree.
  std::string Describe() const
  {
    return this->Path.Describe() + ", needs " + std::to_string(this->FindMissingStep()) +
      ", after " + std::to_string(this->LastStepAdded) + (this->WantsInitial() ? ", initial" : "") +
      (this->Loaded.Band ? ", loaded" : "");
  }

  // Estimate of the spacing before the first frame, see TargetBuilder.
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

  // Returns true if the surface needs SetInitial before it can start.
  bool WantsInitial() const { return this->Shapes.WantsInitial(); }
  void SetInitial(std::shared_ptr<InputShape> shape) { this->Shapes.SetInitial(std::move(shape)); }

  // Advances to the requested time; returns false if `progress` cancelled the motion. Throws
  // std::invalid_argument for invalid settings, and exceptions of NarrowBand and `frames`. An
  // exception at the start resets everything except a loaded state; a later exception leaves the
  // state of the last finished substep.
  bool Advance(const FrameSource& frames, const ProgressFunction& progress);

  // Discards the state, the checkpoints, the history and the frames, but not a loaded state.
  void Reset();

  // The surface after Advance has reached the requested time: this rank's part, or the whole
  // surface if the requested arrays need the whole.
  const NarrowBand& GetBand() const { return *this->ShareBand(); }
  // World position of the band's node (0, 0, 0). The band's positions are relative to this
  // position.
  const std::array<double, 3>& GetOrigin() const { return this->Shapes.GetOrigin(); }
  // Shares ownership of the surface, which is not modified later.
  std::shared_ptr<const NarrowBand> ShareBand() const
  {
    return this->ViewOf(this->ShareWholeBand());
  }
  // The surface without a cut at the sides of a periodic box.
  std::shared_ptr<const NarrowBand> ShareWholeBand() const
  {
    return this->Whole ? this->Whole : this->Path.Share(this->Requested);
  }
  // Returns true if the requested time is a step, so that a motion can resume from the state at
  // that time. False with EvolutionMode EQUILIBRIUM.
  bool IsAtStep() const { return !this->Requested.Between && !this->Settings.IsEquilibrium(); }
  // Returns null if the surface is not at the requested time.
  const NarrowBand* FindSkin() const
  {
    return this->Path.IsAt(this->Requested) ? &this->GetBand() : nullptr;
  }
  // Returns the surface at the time of an earlier request; null if the surface is at another time.
  const NarrowBand* FindSkinAt(const RequestedTime& time) const
  {
    const bool isWhole = this->Whole && time.Time == this->Requested.Time;
    return !this->Path.IsAt(time) ? nullptr
      : isWhole                   ? this->Whole.get()
                                  : this->ViewOf(this->Path.Share(time)).get();
  }

  // Warns once for each reason.
  void Warn(const std::string& reason, const std::string& sentence) const
  {
    this->Messages.Say(reason, sentence);
  }

  // Attributes of the skin at the requested time.
  SkinAttributes FindAttributes() const
  {
    return { this->Settings, this->Shapes, this->Messages, this->Requested, this->Arrays };
  }
  // Returns the parameters of the motion at the requested time, for FindSpeeds.
  Motion GetMotion() const;
  // Values in the interval that ends at the requested time or contains this time; at the first
  // step, in the first interval. All values are 0 if there is neither a domain nor a skin.
  ValuesInUse GetValuesInUse() const
  {
    const int from = this->Requested.Step - (this->Requested.Between ? 0 : 1);
    return this->FindSkin() || this->Shapes.GetDomain()
      ? this->Shapes.FindValuesInUse(this->Driver.GetMotion(std::max(from, 0)))
      : ValuesInUse();
  }

  // Returns the state at the last step up to the surface's time. The band of the result is null if
  // there is no such state: before the start, after an interruption of the motion to the next step,
  // and with EvolutionMode EQUILIBRIUM.
  SavedState GetState() const;
  // Returns the state at the requested time, which may lie between steps.
  SavedState GetRequestedState() const;
  // Returns GetState(); gathers a distributed state on rank 0, and other ranks then get no band.
  // Collective.
  SavedState GatherState() const;
  // Resets the simulation. From now on the surface starts with this state. A change of settings
  // after the next Configure discards the state.
  void SetState(const SavedState& state);
  // Resets the simulation, and discards a loaded state.
  void StartAnew();

  // Rows of the steps up to the requested time; with EQUILIBRIUM of the start and the end.
  std::vector<HistoryRow> GetHistory() const;

  // Null while the bounds are unknown, see TargetBuilder.
  const SurfaceDomain* FindDomain() { return this->Shapes.FindDomain(); }

  const MotionDriver& GetDriver() const { return this->Driver; }
  void ResetCounters() { this->Driver.ResetCounters(); }

private:
  // Returns true if the settings only append steps to the input, and the motion so far stays valid.
  // If an input of one step gets more steps, only the start stays valid: with one step the target
  // is static, and the filter uses its own time steps.
  bool IsLengthenedBy(const SurfaceSettings& settings) const
  {
    const bool isOnSteps =
      this->Settings.Inputs.TargetMoves ? settings.Inputs.TargetMoves : this->Path.IsAtStart();
    return isOnSteps && this->Settings.AreContinuedBy(settings);
  }
  void ResetTrajectory();
  void Rewind(int step);
  SavedState MakeState(
    const std::shared_ptr<const NarrowBand>& band, PipelineTime time, std::size_t rows) const;
  std::size_t CountRows() const; // of the history up to the requested time
  void UseLoadedDomain();
  int FindFirstStep() const;
  void RestoreLoaded();
  bool HasFramesFrom(int step) const;
  ArrayFrames FindArrayFrames() const
  {
    return activesurface::FindArrayFrames(this->Settings, this->Requested, this->Arrays,
      this->Shapes, WantDisplacements(this->Arrays, this->Shapes));
  }
  int FindMissingStepOfArrays() const;
  void PrepareOutputs();
  ProgressFunction GetPartOf(const ProgressFunction& progress) const;

  bool AdvanceLeg(const ProgressFunction& progress);
  void UseNewDomain();
  bool Start(const ProgressFunction& progress);
  bool StartBand(const ProgressFunction& progress);
  bool AdvanceStep(const ProgressFunction& progress);
  bool AdvanceToSteadyState(const ProgressFunction& progress);
  bool AdvanceBranch(const ProgressFunction& progress);
  void Record(std::size_t row, PipelineTime time, const std::string& event);
  // Returns the part of a surface that outputs show: within the sides of a periodic box; without a
  // box the whole surface.
  std::shared_ptr<const NarrowBand> ViewOf(const std::shared_ptr<const NarrowBand>& band) const
  {
    return band && this->Shapes.GetBox().Any() ? this->View.Cut(band, this->Driver.MakeWalls(0.0))
                                               : band;
  }
  // Returns true if `outside`, the fraction of the target outside the skin, has not decreased since
  // the previous row. At row 0, returns true, except on an initial shape that covers a part of the
  // target. The fraction decreases while a skin approaches the target.
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
  bool LacksDomain = false; // began on nothing, and there is no domain yet
  int Unverified = -1;      // step to read again and compare: the source was modified

  RequestedTime Requested;
  RequestedArrays Arrays;
  int FirstStep = -1; // start of the motion to the requested time, for the progress

  Trajectory Path{ this->Settings };
  mutable BoxView View;
  std::shared_ptr<const NarrowBand> Whole; // gathered from all ranks, if outputs need it
  Checkpoints Saved;
  HistoryRecorder History;
  TargetCoverage Coverage{ this->Settings, this->Shapes };
  SavedState Loaded;
  bool LoadedIsNew = false; // set since the last Configure
};

}

#endif
