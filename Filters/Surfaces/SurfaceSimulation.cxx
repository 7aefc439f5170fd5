#include "SurfaceSimulation.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace activesurface
{

void SurfaceSimulation::Configure(const SurfaceSettings& settings)
{
  if (this->Settings != settings)
  {
    this->Drop();
    this->Messages.Forget();
    this->Settings = settings;
  }
}

void SurfaceSimulation::Drop()
{
  this->Shapes.Clear();
  this->LastStepAdded = 0;
  this->ForgetWay();
}

void SurfaceSimulation::ForgetWay()
{
  this->Band.reset();
  this->Branch.reset();
  this->Step = -1;
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
    this->ForgetWay();
  }
  if (goal.Time != this->Goal.Time || this->Step < 0)
  {
    this->FirstStep = this->Step;
  }
  this->Goal = goal;
}

// A surface that has vanished stays at the time at which it did.
bool SurfaceSimulation::IsUnderWay() const
{
  return this->Band &&
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
  if (this->Step < 0 || !this->Settings.InputMoves)
  {
    return this->Shapes.Has(0) ? -1 : 0;
  }
  const bool onTheWay =
    this->Step < this->Goal.Step || (this->Goal.Between && !this->BranchIsAtGoal());
  if (!onTheWay || this->HasFramesFrom(this->Step))
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
    this->Band = std::make_unique<NarrowBand>(domain ? domain->VoxelSize : 1.0);
    const bool finished = isEmpty || this->StartBand(*domain, progress);
    if (isEmpty)
    {
      this->Messages.Say("empty",
        "There are no particles, and nothing else, at the first time step, so there is no skin, "
        "now or later: it does not grow out of nothing. Set an initial shape, or begin with a step "
        "that is not empty.");
    }
    this->Step = finished ? 0 : -1;
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
  const PotentialTarget* shape = initial ? initial.get() : &this->Shapes.GetTarget();
  std::atomic<bool> isFinite{ false }; // anywhere
  InitialFunction function;
  function.ThreadSafe = shape->IsThreadSafe();
  function.Evaluate = [shape, &isFinite](std::size_t count, const double* points, double* values)
  {
    shape->EvaluateLevel(count, points, values);
    if (!isFinite.load(std::memory_order_relaxed) &&
      std::any_of(values, values + count, [](double value) { return std::isfinite(value); }))
    {
      isFinite.store(true, std::memory_order_relaxed);
    }
  };
  this->Band->SetNumberOfThreads(this->Threads);
  this->Band->SetMaximumNumberOfActiveVoxels(this->MaximumVoxels);
  if (!this->Band->Start(0.0, domain.Bounds, function, progress))
  {
    return false;
  }
  if (this->Band->IsEmpty())
  {
    this->Messages.Say("empty",
      isFinite ? "The initial shape has no surface within the bounds, so there is no skin; check "
                 "ModelBounds, TargetIsoValue and whether VoxelSize is small enough."
               : "The initial shape is not a finite number anywhere within the bounds, so there is "
                 "no skin; check the initial shape, or the target where there is none.");
  }
  return true;
}

bool SurfaceSimulation::AdvanceStep(const ProgressFunction& progress)
{
  const double end = this->Settings.GetMotionTime(this->Settings.Steps[this->Step + 1]);
  this->Branch.reset();
  if (!this->AdvanceBand(*this->Band, end, progress))
  {
    return false;
  }
  ++this->Step;
  return true;
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

// From the step, or from where it was interrupted, to a motion time that is not after the next one.
bool SurfaceSimulation::AdvanceBand(NarrowBand& band, double time, const ProgressFunction& progress)
{
  if (band.IsEmpty())
  {
    return true;
  }
  MovingTarget* moving = this->Shapes.GetMovingTarget();
  if (moving && this->Settings.InputMoves)
  {
    const double* steps = this->Settings.Steps.data() + this->Step;
    moving->MoveAlong(
      this->Step, this->Settings.GetMotionTime(steps[0]), this->Settings.GetMotionTime(steps[1]));
  }
  band.SetNumberOfThreads(this->Threads);
  band.SetMaximumNumberOfActiveVoxels(this->MaximumVoxels);
  const AdvanceReport report = this->AdvanceCounting(band, time, progress);
  this->TargetEvaluations += report.TargetEvaluations;
  this->WarnOf(report, time);
  return !report.Aborted;
}

// Counts the substeps that were finished before an exception too.
AdvanceReport SurfaceSimulation::AdvanceCounting(
  NarrowBand& band, double time, const ProgressFunction& progress)
{
  double seen = band.GetTime();
  const auto count = [this, &band, &seen]
  {
    this->Substeps += band.GetTime() > seen ? 1 : 0;
    seen = band.GetTime();
  };
  const auto watch = [&count, &progress](double fraction)
  {
    count();
    return progress(fraction);
  };
  try
  {
    const AdvanceReport report =
      band.Advance(time, this->Settings.Strategy, this->Shapes.GetTarget(), watch);
    count();
    return report;
  }
  catch (...)
  {
    count();
    throw;
  }
}

const NarrowBand& SurfaceSimulation::GetBand() const
{
  return this->Goal.Between ? *this->Branch : *this->Band;
}

void SurfaceSimulation::WarnOf(const AdvanceReport& report, double time)
{
  if (report.Vanished && !report.Aborted)
  {
    std::ostringstream text;
    text << "The skin has vanished before the motion time " << time
         << "; it does not come back. Does the target meet the initial shape?";
    this->Messages.Say("vanished", text.str());
  }
  if (report.DroppedSamples > 0)
  {
    std::ostringstream text;
    text << "On the way to the motion time " << time << " the target was not a finite number at "
         << report.DroppedSamples << " of " << report.TargetEvaluations
         << " points of the skin; they were left out. This is told once.";
    this->Messages.Say("not finite", text.str());
  }
}

}
