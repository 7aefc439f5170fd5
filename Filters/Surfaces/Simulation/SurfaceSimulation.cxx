#include "Simulation/SurfaceSimulation.h"

#include "Simulation/MotionWarnings.h"
#include "Targets/OwnedParticles.h"

#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <stdexcept>

namespace activesurface
{

void SurfaceSimulation::SetLimits(const SimulationLimits& limits)
{
  this->Driver.SetNumberOfThreads(limits.Threads);
  this->Driver.SetMaximumNumberOfActiveVoxels(limits.MaximumVoxels);
  this->Shapes.SetMaximumNumberOfActiveVoxels(limits.MaximumVoxels);
  this->Saved.SetLimits(limits.CheckpointInterval, limits.CheckpointMemory << 20);
}

void SurfaceSimulation::Configure(const SurfaceSettings& settings)
{
  if (this->IsLengthenedBy(settings))
  {
    if (settings.Inputs.TargetMoves != this->Settings.Inputs.TargetMoves)
    {
      this->Shapes.ForgetTarget(); // was made as a static target without velocities
    }
    if (settings.Inputs.TargetMTime != this->Settings.Inputs.TargetMTime &&
      !settings.Inputs.OnlyForward)
    {
      this->Unverified = this->Shapes.GetFrames().FindLastStep();
    }
    this->Settings = settings;
    this->History.SetFirstTime(settings.GetStep(0));
  }
  if (this->Settings != settings)
  {
    this->Restarts.Note(this->Settings, settings, this->Path.HasBegun(), this->Requested.Time);
    this->Loaded = this->LoadedIsNew ? this->Loaded : SavedState();
    this->Reset();
    this->Messages.Forget();
    this->Settings = settings;
  }
  this->LoadedIsNew = false;
  this->UseLoadedDomain();
}

void SurfaceSimulation::Reset()
{
  this->Unverified = -1;
  this->LacksDomain = false;
  this->Shared.Clear();
  this->Shapes.Clear();
  this->Coverage.Clear();
  this->Driver.Clear();
  this->LastStepAdded = 0;
  this->Saved.Clear();
  this->ResetTrajectory();
  this->History.Clear();
}

void SurfaceSimulation::ResetTrajectory()
{
  this->Path.Reset();
  this->Whole.reset();
  this->History.Interrupt();
}

// Restores the last checkpoint up to a step, if this checkpoint is later than the surface.
void SurfaceSimulation::Rewind(int step)
{
  const int saved = this->Saved.FindUpTo(step);
  if (saved > this->Path.GetStep())
  {
    this->ResetTrajectory();
    try
    {
      this->Path.Begin(saved, this->Saved.Restore(saved));
      this->History.ContinueFrom(this->ViewOf(this->Path.ShareAtStep()));
    }
    catch (const std::exception&)
    {
      this->ResetTrajectory(); // out of memory: a motion from the start may need less
    }
  }
}

void SurfaceSimulation::Request(PipelineTime time, const RequestedArrays& arrays)
{
  this->Arrays = arrays;
  if (this->Settings.Inputs.Steps.empty())
  {
    return;
  }
  const RequestedTime requested = this->Settings.FindRequested(time);
  this->Restarts.Report(requested.Time, this->Messages);
  const int step = this->Path.GetStep();
  if (requested.Step < step || (requested.Step == step && this->Path.IsUnfinished()))
  {
    if (this->Settings.Inputs.OnlyForward && !this->Path.IsUnfinished())
    {
      this->Saved.Keep(step, this->Path.GetBand()); // a forward-only input cannot repeat this step
    }
    this->ResetTrajectory();
  }
  this->Rewind(requested.Step);
  if (requested.Time != this->Requested.Time || !this->Path.HasBegun())
  {
    this->FirstStep = this->Path.GetStep();
  }
  this->Requested = requested;
}

bool SurfaceSimulation::HasFramesFrom(int step) const
{
  return !this->Settings.UsesInput() ||
    (this->Settings.Inputs.TargetMoves ? this->Shapes.Has(step) && this->Shapes.Has(step + 1)
                                       : this->Shapes.Has(0));
}

int SurfaceSimulation::FindMissingStep() const
{
  const bool moves = this->Settings.Inputs.TargetMoves;
  const int step = this->Path.GetStep();
  if (this->Unverified >= 0)
  {
    return this->Unverified;
  }
  if (!this->Settings.UsesInput())
  {
    return -1;
  }
  const int first = this->FindFirstStep();
  if ((step < 0 || !moves) && !this->Shapes.Has(first))
  {
    return first;
  }
  const bool hasArrived =
    step == this->Requested.Step && (!this->Requested.Between || this->Path.IsAt(this->Requested));
  if (hasArrived)
  {
    return this->FindMissingStepOfArrays();
  }
  if (step < 0 || this->HasFramesFrom(step))
  {
    return -1;
  }
  return this->Shapes.Has(step) ? step + 1 : step;
}

// Returns the step of a frame that the arrays need and that is not stored, as after a return to a
// checkpoint, or was read without these arrays; -1: none.
int SurfaceSimulation::FindMissingStepOfArrays() const
{
  if (!this->Arrays.Speeds && !this->Arrays.NeedParticles())
  {
    return -1;
  }
  const ArrayFrames needed = this->FindArrayFrames();
  for (int step = needed.First; step <= needed.Last; ++step)
  {
    if (!HasArrays(this->Shapes, step, this->Arrays))
    {
      return step;
    }
  }
  return -1;
}

void SurfaceSimulation::AddFrame(int step, std::shared_ptr<InputShape> shape)
{
  this->LastStepAdded = step;
  if (step == this->Unverified)
  {
    this->Unverified = -1;
    if (this->Shapes.IsUnchanged(step, *shape))
    {
      return;
    }
    this->Reset(); // another series that begins with the same times
    this->Loaded = SavedState();
    this->FirstStep = this->Path.GetStep();
    this->LastStepAdded = step;
    if (shape->Owned) // the spacing is estimated from all particles
    {
      shape = GatherShape(*shape);
    }
  }
  this->Shapes.Add(step, shape);
  this->Shared.Add(step, shape);
}

bool SurfaceSimulation::Advance(const FrameSource& frames, const ProgressFunction& progress)
{
  this->Settings.Check();
  while (true)
  {
    for (int step = this->FindMissingStep(); step >= 0; step = this->FindMissingStep())
    {
      this->AddFrame(step, frames(step));
    }
    if (this->Path.IsAt(this->Requested))
    {
      this->PrepareOutputs();
      return true;
    }
    if (!this->AdvanceLeg(this->GetPartOf(progress)))
    {
      return false;
    }
  }
}

// Gathers the whole skin, and the particles, from all ranks if outputs need them.
void SurfaceSimulation::PrepareOutputs()
{
  this->Whole.reset();
  if (!this->Arrays.NeedWhole())
  {
    return;
  }
  if (this->Arrays.Speeds || this->Arrays.NeedParticles())
  {
    const ArrayFrames needed = this->FindArrayFrames();
    this->Shared.MakeWhole(needed.First, needed.Last);
  }
  const std::shared_ptr<const NarrowBand> band = this->Path.Share(this->Requested);
  this->Whole = band->GetPart() ? band->GatherWhole(true) : nullptr;
}

// Maps the progress of the next step to that of the whole motion, from FirstStep to the requested
// time.
ProgressFunction SurfaceSimulation::GetPartOf(const ProgressFunction& progress) const
{
  const double parts = this->Requested.Step - this->FirstStep + (this->Requested.Between ? 1 : 0);
  const double done = this->Path.GetStep() - this->FirstStep;
  return [progress, parts, done](double fraction)
  { return !progress || progress(std::min((done + fraction) / std::max(parts, 1.0), 1.0)); };
}

bool SurfaceSimulation::AdvanceLeg(const ProgressFunction& progress)
{
  this->View.Clear(); // otherwise moving the band, which a view shares, would copy it
  this->Whole.reset();
  if (!this->Path.HasBegun())
  {
    return this->Start(progress);
  }
  this->UseNewDomain();
  if (this->Settings.IsEquilibrium())
  {
    return this->AdvanceToSteadyState(progress);
  }
  return this->Path.GetStep() < this->Requested.Step ? this->AdvanceStep(progress)
                                                     : this->AdvanceBranch(progress);
}

bool SurfaceSimulation::AdvanceStep(const ProgressFunction& progress)
{
  const int step = this->Path.GetStep();
  NarrowBand& band = this->Path.GetBandToMove();
  const MotionTime end = this->Settings.GetMotionTimeOf(step + 1);
  this->Shared.Place(band, step, step + 1);
  if (!this->Driver.AdvanceTo(band, step, end, progress))
  {
    return false;
  }
  this->Path.FinishStep();
  this->Record(static_cast<std::size_t>(step) + 1, this->Settings.GetStep(step + 1), "");
  return true;
}

bool SurfaceSimulation::AdvanceToSteadyState(const ProgressFunction& progress)
{
  AdvanceReport report;
  NarrowBand& band = this->Path.GetBandToMove();
  if (!this->Driver.AdvanceToSteadyState(band, progress, report))
  {
    return false;
  }
  this->Path.FinishSteadyState();
  this->Record(1, this->Settings.ToPipelineTime({ band.GetTime() }), DescribeRest(report));
  return true;
}

bool SurfaceSimulation::AdvanceBranch(const ProgressFunction& progress)
{
  const PipelineTime end = this->Requested.Time;
  const int step = this->Path.GetStep();
  NarrowBand& band = this->Path.GetBranchTo(end);
  this->Shared.Place(band, step, step + 1);
  const bool isThere =
    this->Driver.AdvanceTo(band, step, this->Settings.ToMotionTime(end), progress);
  if (isThere)
  {
    this->Path.FinishBranch();
  }
  return isThere;
}

void SurfaceSimulation::Record(std::size_t row, PipelineTime time, const std::string& event)
{
  NarrowBand& band = this->Path.GetBandToMove();
  const int step = this->Path.GetStep();
  const Motion motion = this->Driver.GetMotion(step);
  const std::shared_ptr<const NarrowBand> view = this->ViewOf(this->Path.ShareAtStep());
  const double outside = this->Coverage.FindOutside(band, motion, step);
  if (HasTargetSpeed(motion) && !this->Settings.ArrivesAfter({ band.GetTime() }) &&
    !band.IsEmpty() && event != NotAtRest && this->Loses(row, outside))
  {
    const bool areParticles = this->Shapes.HasParticles(step, step) && !this->Settings.Invert;
    WarnOfOutside({ time, outside, motion, areParticles }, this->Messages);
  }
  this->History.Record(row, *view, { time, outside, event });
  band.ForgetWork();
  this->Saved.Add(step, band);
}

}
