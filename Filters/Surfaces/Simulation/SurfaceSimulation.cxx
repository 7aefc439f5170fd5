#include "Simulation/SurfaceSimulation.h"

#include "Simulation/MotionWarnings.h"
#include "Simulation/SurfaceStart.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <stdexcept>

namespace activesurface
{

namespace
{

// Least number of substeps from one step to the next while the target moves: so many times it is
// looked at on its way, however slow the surface is.
constexpr double SubstepsOfMovingTarget = 4.0;

}

void SurfaceSimulation::Configure(const SurfaceSettings& settings)
{
  if (this->Settings.AreContinuedBy(settings) && this->IsOnStepsOf(settings))
  {
    this->Settings = settings;
    if (!this->History.empty())
    {
      this->History.front().Time = settings.Steps.front();
    }
  }
  if (this->Settings != settings)
  {
    this->Loaded = this->LoadedIsNew ? this->Loaded : SavedState();
    this->Drop();
    this->Messages.Forget();
    this->Settings = settings;
  }
  this->LoadedIsNew = false;
}

// Whether the way so far is one along these steps. An input of one step stands still, and the
// filter has its own clock as long as it does.
bool SurfaceSimulation::IsOnStepsOf(const SurfaceSettings& settings) const
{
  return this->Settings.InputMoves ? settings.InputMoves
                                   : this->Step <= 0 && !this->IsUnderWay() && !this->Branch;
}

void SurfaceSimulation::Drop()
{
  this->Shapes.Clear();
  this->LastStepAdded = 0;
  this->Saved.Clear();
  this->History.clear();
  this->ForgetWay();
}

void SurfaceSimulation::ForgetWay()
{
  this->Band.reset();
  this->Branch.reset();
  this->Step = -1;
  this->Settled = false;
  this->Historian = HistoryWriter();
}

// Takes the surface to the last checkpoint up to a step, if that is nearer.
void SurfaceSimulation::Rewind(int step)
{
  const int saved = this->Saved.FindUpTo(step);
  if (saved > this->Step)
  {
    this->ForgetWay();
    try
    {
      this->Band = this->Saved.Restore(saved);
      this->Historian.Restart(*this->Band);
      this->Step = saved;
    }
    catch (const std::exception&)
    {
      this->ForgetWay(); // no memory for it: the long way may do with less
    }
  }
}

void SurfaceSimulation::SetGoal(double pipelineTime)
{
  if (this->Settings.Steps.empty())
  {
    return;
  }
  const GoalTime goal = FindGoal(this->Settings.Steps, pipelineTime);
  if (goal.Step < this->Step || (goal.Step == this->Step && this->IsUnderWay()))
  {
    if (this->Settings.OnlyForward && !this->IsUnderWay())
    {
      this->Saved.Keep(this->Step, *this->Band); // it cannot be reached again
    }
    this->ForgetWay();
  }
  this->Rewind(goal.Step);
  if (goal.Time != this->Goal.Time || this->Step < 0)
  {
    this->FirstStep = this->Step;
  }
  this->Goal = goal;
}

// A surface that has vanished stays at the time at which it did.
bool SurfaceSimulation::IsUnderWay() const
{
  return this->Band && !this->Settings.Settles &&
    this->Band->GetTime() > this->Settings.GetMotionTime(this->Settings.Steps[this->Step]);
}

bool SurfaceSimulation::HasFramesFrom(int step) const
{
  return !this->Settings.UsesInput() ||
    (this->Settings.InputMoves ? this->Shapes.Has(step) && this->Shapes.Has(step + 1)
                               : this->Shapes.Has(0));
}

bool SurfaceSimulation::BranchIsAtGoal() const
{
  return this->Branch && this->BranchTime == this->Goal.Time && !this->BranchIsUnderWay;
}

int SurfaceSimulation::GetStepWanted() const
{
  if (!this->Settings.UsesInput())
  {
    return -1;
  }
  if ((this->Step < 0 || !this->Settings.InputMoves) && !this->Shapes.Has(0))
  {
    return 0;
  }
  const bool onTheWay = this->Step < 0 || this->Step < this->Goal.Step ||
    (this->Goal.Between && !this->BranchIsAtGoal());
  if (!onTheWay)
  {
    return this->GetStepWantedAtGoal();
  }
  if (this->Step < 0 || this->HasFramesFrom(this->Step))
  {
    return -1;
  }
  return this->Shapes.Has(this->Step) ? this->Step + 1 : this->Step;
}

void SurfaceSimulation::AddFrame(int step, TargetFrame frame)
{
  this->Shapes.Add(step, std::move(frame));
  this->LastStepAdded = step;
}

SurfaceSimulation::Outcome SurfaceSimulation::Advance(const ProgressFunction& progress)
{
  this->Settings.Check();
  bool finished = true;
  while (finished && this->GetStepWanted() < 0)
  {
    const ProgressFunction part = this->GetPartOf(progress);
    if (this->Step < 0)
    {
      finished = this->Start(part);
    }
    else if (this->Settings.Settles && !this->Settled)
    {
      finished = this->Settle(part);
    }
    else if (this->Step < this->Goal.Step)
    {
      finished = this->AdvanceStep(part);
    }
    else if (this->Goal.Between && !this->BranchIsAtGoal())
    {
      finished = this->AdvanceBranch(part);
    }
    else
    {
      return Outcome::AtGoal;
    }
  }
  return finished ? Outcome::NeedsFrame : Outcome::Aborted;
}

// Of the way to the goal, from the start or the step where it began, the next step.
ProgressFunction SurfaceSimulation::GetPartOf(const ProgressFunction& progress) const
{
  const double parts = this->Goal.Step - this->FirstStep + (this->Goal.Between ? 1 : 0);
  const double done = this->Step - this->FirstStep;
  return [progress, parts, done](double fraction)
  { return !progress || progress(std::min((done + fraction) / std::max(parts, 1.0), 1.0)); };
}

bool SurfaceSimulation::Start(const ProgressFunction& progress)
{
  try
  {
    const SurfaceDomain* domain = this->FindDomain();
    const bool isEmpty = this->Shapes.StartsOnNothing();
    if (!domain && !isEmpty)
    {
      throw std::invalid_argument("The bounds of the target are not known; set ModelBounds to a "
                                  "box around the shape that the skin starts with.");
    }
    if (this->Loaded.Band && domain)
    {
      this->Shapes.StartTarget();
      this->TakeLoaded();
      this->Rewind(this->Goal.Step);
      if (this->Step >= 0)
      {
        return true;
      }
    }
    this->Band = std::make_unique<NarrowBand>(domain ? domain->VoxelSize : 1.0);
    const bool finished = isEmpty || this->StartBand(*domain, progress);
    if (isEmpty)
    {
      this->Messages.Say("empty",
        "There are no particles, and nothing else, at the first time step, so there is no skin, "
        "now or later: it does not grow out of nothing. Set an initial shape, or begin with a step "
        "that is not empty.");
    }
    if (finished)
    {
      this->Step = 0;
      this->AddToHistory(this->Settings.Steps.front(), "");
    }
    return finished;
  }
  catch (...)
  {
    this->Drop();
    throw;
  }
}

bool SurfaceSimulation::StartBand(const SurfaceDomain& domain, const ProgressFunction& progress)
{
  this->Shapes.StartTarget();
  const std::unique_ptr<PotentialTarget> initial = this->Shapes.MakeStart();
  const PotentialTarget& shape = initial ? *initial : this->Shapes.GetTarget();
  this->Band->SetNumberOfThreads(this->Threads);
  this->Band->SetMaximumNumberOfActiveVoxels(this->MaximumVoxels);
  return StartOn(*this->Band, { domain, this->GetMotion().Box, shape }, this->Messages, progress);
}

// The band goes on as a copy while an output, at another port or elsewhere, holds it.
void SurfaceSimulation::KeepWhatIsShared()
{
  if (this->Band.use_count() > 1)
  {
    this->Band = this->Band->Clone();
  }
}

bool SurfaceSimulation::AdvanceStep(const ProgressFunction& progress)
{
  const double end = this->Settings.GetMotionTime(this->Settings.Steps[this->Step + 1]);
  this->Branch.reset();
  this->KeepWhatIsShared();
  if (!this->AdvanceBand(*this->Band, end, progress))
  {
    return false;
  }
  ++this->Step;
  this->AddToHistory(this->Settings.Steps[this->Step], "");
  return true;
}

bool SurfaceSimulation::Settle(const ProgressFunction& progress)
{
  this->KeepWhatIsShared();
  const double never = std::numeric_limits<double>::infinity();
  const AdvanceReport report = this->AdvanceCounting(*this->Band, never, progress);
  WarnOfMotion(report, this->Band->GetTime(), this->Messages);
  if (report.Aborted)
  {
    return false;
  }
  this->Settled = true;
  const bool rests = report.IsSteady || report.Vanished;
  if (!rests)
  {
    WarnOfNoRest(this->Settings.Rest, report.SurfaceSpeed, this->Messages);
  }
  const double time =
    this->Settings.Steps.front() + this->Band->GetTime() / this->Settings.TimeScale;
  this->AddToHistory(time, rests ? "at rest" : "not at rest");
  return true;
}

Motion SurfaceSimulation::GetMotion()
{
  Motion motion = this->Settings.Strategy;
  const SurfaceDomain* domain = this->FindDomain();
  motion.Box.Present = this->Settings.Bounded && domain;
  if (domain)
  {
    std::copy_n(domain->Bounds, 6, motion.Box.Bounds);
  }
  if (this->Settings.InputMoves && this->Step >= 0 &&
    this->Step + 1 < static_cast<int>(this->Settings.Steps.size()))
  {
    const double* steps = this->Settings.Steps.data() + this->Step;
    motion.LongestStep = this->Settings.TimeScale * (steps[1] - steps[0]) / SubstepsOfMovingTarget;
  }
  return motion;
}

bool SurfaceSimulation::AdvanceBranch(const ProgressFunction& progress)
{
  if (!this->Branch || this->BranchTime != this->Goal.Time)
  {
    this->Branch = this->Band->Clone();
    this->BranchTime = this->Goal.Time;
    this->BranchIsUnderWay = true;
  }
  const double end = this->Settings.GetMotionTime(this->Goal.Time);
  this->BranchIsUnderWay = !this->AdvanceBand(*this->Branch, end, progress);
  return !this->BranchIsUnderWay;
}

// On its way to the next step, if that is known.
void SurfaceSimulation::PlaceTargetFrom(int step)
{
  MovingTarget* moving = this->Shapes.GetMovingTarget();
  if (moving && this->Settings.InputMoves)
  {
    const int next = this->Shapes.Has(step + 1) ? step + 1 : step;
    moving->MoveAlong(step, this->Settings.GetMotionTime(this->Settings.Steps[step]),
      this->Settings.GetMotionTime(this->Settings.Steps[next]));
  }
}

// From the step, or from where it was interrupted, to a motion time that is not after the next one.
bool SurfaceSimulation::AdvanceBand(NarrowBand& band, double time, const ProgressFunction& progress)
{
  if (band.IsEmpty())
  {
    return true;
  }
  this->PlaceTargetFrom(this->Step);
  band.SetNumberOfThreads(this->Threads);
  band.SetMaximumNumberOfActiveVoxels(this->MaximumVoxels);
  const AdvanceReport report = this->AdvanceCounting(band, time, progress);
  WarnOfMotion(report, time, this->Messages);
  return !report.Aborted;
}

// To a motion time, or to rest if that is infinite. Counts what was done before an exception too.
AdvanceReport SurfaceSimulation::AdvanceCounting(
  NarrowBand& band, double time, const ProgressFunction& progress)
{
  const AdvanceReport before = band.GetWork();
  const auto count = [this, &band, &before]
  {
    this->Substeps += band.GetWork().Substeps - before.Substeps;
    this->TargetEvaluations += band.GetWork().TargetEvaluations - before.TargetEvaluations;
  };
  try
  {
    const Motion motion = this->GetMotion();
    SteadyStateCriterion rest = this->Settings.Rest;
    rest.MaximumSubsteps -= std::min(before.Substeps, rest.MaximumSubsteps);
    PotentialTarget& target = this->Shapes.GetTarget();
    const AdvanceReport report = std::isfinite(time)
      ? band.Advance(time, motion, target, progress)
      : band.AdvanceToSteadyState(motion, rest, target, progress);
    count();
    return report;
  }
  catch (...)
  {
    count();
    throw;
  }
}

}
