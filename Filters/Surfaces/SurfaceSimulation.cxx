#include "SurfaceSimulation.h"

#include "vtkBoundingBox.h"
#include "vtkSkeletonPotential.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace activesurface
{

namespace
{

// Spacing of the samples that stand in for the gradients that a function does not give [voxels].
constexpr double DifferenceStep = 0.125;

// Reach of the particles in units of their distance, when it is not given: balls of neighbours
// overlap enough to be one body.
constexpr double RadiusPerSpacing = 2.0;

// A time that is so near a step, in units of the distance to the next one, is that step.
constexpr double RoundingOfTimes = 1e-6;

}

void SurfaceSimulation::Configure(const SurfaceSettings& settings)
{
  if (this->Settings != settings)
  {
    this->Drop();
    this->Told.clear();
    this->Settings = settings;
  }
}

void SurfaceSimulation::Drop()
{
  this->Frames.Clear();
  this->LastStepAdded = 0;
  this->EstimatedRadius = 0.0;
  this->DomainKnown = false;
  this->MovingAttractor = nullptr;
  this->Attractor.reset();
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
  const GoalTime goal = this->FindGoal(pipelineTime);
  if (goal.Step < this->Step)
  {
    this->Band.reset();
    this->Branch.reset();
    this->Step = -1;
  }
  if (goal.Time != this->Goal.Time || this->Step < 0)
  {
    this->FirstStep = this->Step;
  }
  this->Goal = goal;
}

SurfaceSimulation::GoalTime SurfaceSimulation::FindGoal(double pipelineTime) const
{
  const std::vector<double>& steps = this->Settings.Steps;
  const double time = pipelineTime > steps.front() ? pipelineTime : steps.front();
  const auto after = std::upper_bound(steps.begin(), steps.end(), time);
  GoalTime goal;
  goal.Step = std::max(0, static_cast<int>(after - steps.begin()) - 1);
  goal.Time = steps[goal.Step];
  if (after == steps.end())
  {
    return goal;
  }
  const double tolerance = RoundingOfTimes * (*after - goal.Time);
  if (*after - time <= tolerance)
  {
    ++goal.Step;
    goal.Time = *after;
  }
  else if (time - goal.Time > tolerance)
  {
    goal.Time = time;
    goal.Between = true;
  }
  return goal;
}

bool SurfaceSimulation::HasParticlesFrom(int step) const
{
  return !this->UsesParticles() ||
    (this->Settings.ParticlesMove ? this->Frames.Has(step) && this->Frames.Has(step + 1)
                                  : this->Frames.Has(0));
}

bool SurfaceSimulation::BranchIsAtGoal() const
{
  return this->Branch && this->BranchTime == this->Goal.Time;
}

int SurfaceSimulation::GetStepWanted() const
{
  if (!this->UsesParticles())
  {
    return -1;
  }
  if (this->Step < 0 || !this->Settings.ParticlesMove)
  {
    return this->Frames.Has(0) ? -1 : 0;
  }
  const bool onTheWay =
    this->Step < this->Goal.Step || (this->Goal.Between && !this->BranchIsAtGoal());
  if (!onTheWay || this->HasParticlesFrom(this->Step))
  {
    return -1;
  }
  return this->Frames.Has(this->Step) ? this->Step + 1 : this->Step;
}

void SurfaceSimulation::AddParticles(int step, ParticleFrame frame)
{
  if (frame.Ignored > 0)
  {
    std::ostringstream text;
    text << frame.Ignored << " particles are left out at the time step "
         << this->Settings.Steps.at(step)
         << ": coordinates, radius or strength are not finite, or the radius is not > 0.";
    this->Warn("ignored particles", text.str());
  }
  this->GiveRadii(frame);
  this->Frames.Add(step, std::move(frame));
  this->LastStepAdded = step;
}

void SurfaceSimulation::GiveRadii(ParticleFrame& frame)
{
  if (frame.HasRadii || frame.Particles.empty())
  {
    return;
  }
  if (this->Settings.Particles.Radius == 0.0 && this->EstimatedRadius == 0.0)
  {
    this->EstimatedRadius = RadiusPerSpacing * frame.GetSpacing();
    if (this->EstimatedRadius == 0.0)
    {
      throw std::invalid_argument(
        "The particles' radius cannot be estimated, as no two of them are "
        "apart; set ParticleRadius or choose a radius array.");
    }
    std::ostringstream text;
    text << "ParticleRadius is not set; " << this->EstimatedRadius << " is used, "
         << RadiusPerSpacing << " times the usual distance of neighbours. Set it to silence this.";
    this->Warn("radius", text.str());
  }
  frame.GiveRadius(
    this->EstimatedRadius > 0.0 ? this->EstimatedRadius : this->Settings.Particles.Radius);
}

const SurfaceDomain* SurfaceSimulation::FindDomain()
{
  if (this->DomainKnown)
  {
    return &this->Domain;
  }
  this->Settings.Check();
  double bounds[6];
  if (this->Settings.BoundsGiven)
  {
    this->Domain = MakeDomain(this->Settings);
    this->DomainKnown = true;
  }
  else if (this->FindShapeBounds(bounds))
  {
    this->Domain = MakeDomain(this->Settings, bounds);
    this->DomainKnown = true;
  }
  return this->DomainKnown ? &this->Domain : nullptr;
}

// Of the first target and the initial shape, as far as they have any.
bool SurfaceSimulation::FindShapeBounds(double bounds[6]) const
{
  vtkBoundingBox box;
  const auto add = [&box, bounds](bool known) { known ? box.AddBounds(bounds) : void(); };
  if (this->UsesParticles())
  {
    if (!this->Frames.Has(0))
    {
      return false;
    }
    add(this->Frames.Get(0).GetBounds(bounds));
  }
  for (vtkImplicitFunction* function :
    { this->Settings.TargetFunction, this->Settings.InitialFunction })
  {
    auto skeleton = vtkSkeletonPotential::SafeDownCast(function);
    add(skeleton && !skeleton->GetTransform() && skeleton->GetSkeletonBounds(bounds));
  }
  if (box.IsValid())
  {
    box.GetBounds(bounds);
  }
  return box.IsValid() != 0;
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
  if (finished)
  {
    return Outcome::NeedsParticles;
  }
  this->Drop();
  return Outcome::Aborted;
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
  const SurfaceDomain* domain = this->FindDomain();
  if (!domain && this->UsesParticles() && !this->Settings.InitialFunction)
  {
    this->Warn("empty",
      "There are no particles at the first time step, so there is no skin, now or later: it does "
      "not grow "
      "out of nothing. Set InitialFunction, or begin with a step that has particles.");
    this->Band = std::make_unique<NarrowBand>(1.0);
    this->Step = 0;
    return true;
  }
  if (!domain)
  {
    throw std::invalid_argument("The bounds of the target are not known; set ModelBounds to a box "
                                "around the shape that the skin starts with.");
  }
  this->MakeTarget(*domain);
  if (!this->StartBand(*domain, progress))
  {
    return false;
  }
  this->Step = 0;
  if (this->Band->IsEmpty())
  {
    this->Warn("empty",
      "The initial shape has no surface within the bounds, so there is no skin; "
      "check ModelBounds, TargetIsoValue and whether VoxelSize is small enough.");
  }
  return true;
}

void SurfaceSimulation::MakeTarget(const SurfaceDomain& domain)
{
  const SurfaceSettings& settings = this->Settings;
  const TargetOptions options{ settings.IsoValue, settings.Invert, settings.Normalize,
    domain.Reach };
  if (!this->UsesParticles())
  {
    this->Attractor = std::make_unique<ImplicitTarget>(
      settings.TargetFunction, DifferenceStep * domain.VoxelSize, options);
    return;
  }
  auto particles = std::make_unique<ParticleTarget>(
    this->Frames, settings.Particles.Kernel, settings.Particles.Threshold, options);
  this->MovingAttractor = particles.get();
  this->MovingAttractor->MoveAlong(0, 0.0, 0.0);
  this->Attractor = std::move(particles);
}

bool SurfaceSimulation::StartBand(const SurfaceDomain& domain, const ProgressFunction& progress)
{
  std::unique_ptr<PotentialTarget> initial;
  if (this->Settings.InitialFunction)
  {
    initial = std::make_unique<ImplicitTarget>(
      this->Settings.InitialFunction, DifferenceStep * domain.VoxelSize, TargetOptions());
  }
  const PotentialTarget* shape = initial ? initial.get() : this->Attractor.get();
  InitialFunction function;
  function.ThreadSafe = shape->IsThreadSafe();
  function.Evaluate = [shape](std::size_t count, const double* points, double* values)
  { shape->EvaluateLevel(count, points, values); };
  this->Band = std::make_unique<NarrowBand>(domain.VoxelSize);
  this->Band->SetNumberOfThreads(this->Threads);
  this->Band->SetMaximumNumberOfActiveVoxels(this->MaximumVoxels);
  return this->Band->Start(0.0, domain.Bounds, function, progress);
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
  this->Branch = this->Band->Clone();
  this->BranchTime = this->Goal.Time;
  return this->AdvanceBand(*this->Branch, this->Settings.GetMotionTime(this->Goal.Time), progress);
}

// From the step to a motion time that is not after the next one.
bool SurfaceSimulation::AdvanceBand(NarrowBand& band, double time, const ProgressFunction& progress)
{
  if (band.IsEmpty())
  {
    return true;
  }
  if (this->MovingAttractor && this->Settings.ParticlesMove)
  {
    const double* steps = this->Settings.Steps.data() + this->Step;
    this->MovingAttractor->MoveAlong(
      this->Step, this->Settings.GetMotionTime(steps[0]), this->Settings.GetMotionTime(steps[1]));
  }
  band.SetNumberOfThreads(this->Threads);
  band.SetMaximumNumberOfActiveVoxels(this->MaximumVoxels);
  const AdvanceReport report =
    band.Advance(time, this->Settings.Strategy, *this->Attractor, progress);
  this->Substeps += report.Substeps;
  this->TargetEvaluations += report.TargetEvaluations;
  this->WarnOf(report, time);
  return !report.Aborted;
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
    this->Warn("vanished", text.str());
  }
  if (report.DroppedSamples > 0)
  {
    std::ostringstream text;
    text << "On the way to the motion time " << time << " the target was not a finite number at "
         << report.DroppedSamples << " of " << report.TargetEvaluations
         << " points of the skin; they were left out.";
    this->Warn(text.str(), text.str());
  }
}

void SurfaceSimulation::Warn(const std::string& reason, const std::string& sentence)
{
  if (this->Told.insert(reason).second && this->Tell)
  {
    this->Tell(sentence);
  }
}

}
