#include "Simulation/MotionDriver.h"

#include "Simulation/MotionWarnings.h"
#include "Simulation/SurfaceStart.h"
#include "Targets/FunctionObstacle.h"

#include <algorithm>

namespace activesurface
{

namespace
{

// Least number of substeps from one step to the next while the target moves: so many times it is
// evaluated on its way, however slow the surface is.
constexpr double SubstepsOfMovingTarget = 4.0;
// The same where the surface is carried along in one semi-Lagrangian step.
constexpr double SubstepsOfCarriedSurface = 2.0;

// The node scheme evaluates the target only near its surface: the skin has to come close in a time
// step, by this number of factors e at least.
constexpr double FewestFactorsOfNodes = 2.0;

// Automatic attraction: distances fall by so many factors e from one step to the next.
constexpr double FactorsPerStep = 6.0;
// Automatic tension, in units of Attraction * (half of the particles' spacing)^2.
constexpr double TensionOfSpacing = 1.0 / 6.0;
// Automatic tension of the node scheme, which weighs it by 1/3 in a body of half the bulk.
constexpr double TensionOfSpacingAtNodes = 1.0 / 2.0;

constexpr char NoNodes[] =
  "TimeIntegration NODES needs particles with time steps, and an Attraction of two over their "
  "length at least; explicit substeps are used instead. Set AutomaticAttraction, or "
  "TimeIntegration to AUTOMATIC.";
constexpr char NoSkinOnNodes[] =
  "The particles have no surface that the voxels can hold, or the obstacle covers it, so there is "
  "no skin; check VoxelSize, ParticleRadius, ModelBounds and ObstacleFunction.";

}

MotionDriver::MotionDriver(
  const SurfaceSettings& settings, TargetBuilder& shapes, Warnings& messages)
  : Settings(settings)
  , Shapes(shapes)
  , Messages(messages)
{
}

void MotionDriver::Prepare(NarrowBand& band) const
{
  band.SetNumberOfThreads(this->Threads);
  band.SetMaximumNumberOfActiveVoxels(this->MaximumVoxels);
  band.SetRanks(this->Ranks);
}

bool MotionDriver::Start(
  NarrowBand& band, const SurfaceDomain& domain, const ProgressFunction& progress)
{
  this->Shapes.StartTarget();
  if (this->StartsOnNodes())
  {
    this->Prepare(band);
    this->StartOnNodes(band, domain);
    return true;
  }
  const std::unique_ptr<PotentialTarget> shape = this->Shapes.MakeStart();
  this->Prepare(band);
  const Motion motion = this->GetMotion(-1);
  const bool isStarted = StartOn(band,
    { domain, motion.Box, motion.Solid, shape ? *shape : this->Shapes.GetTarget(), this->Ranks },
    this->Messages, progress);
  if (isStarted)
  {
    band.RestoreTargets(motion);
  }
  return isStarted;
}

bool MotionDriver::StartsOnNodes() const
{
  return this->Settings.UsesNodes() && !this->Settings.StartsElsewhere() &&
    this->Shapes.HasParticles(0, 0);
}

// Particles that stand still keep the skin that starts on them.
bool MotionDriver::StaysOnNodes() const
{
  return !this->Settings.Inputs.TargetMoves && this->StartsOnNodes();
}

// Starts as after a time step of the automatic attraction, so that the first frame is as smooth as
// the others. The length of the step does not matter, as it may be unknown yet.
void MotionDriver::StartOnNodes(NarrowBand& band, const SurfaceDomain& domain)
{
  Motion motion = this->GetMotion(-1);
  motion.Integration = TimeIntegration::Nodes;
  const double given = motion.Tension / motion.Attraction;
  motion.Attraction = FactorsPerStep; // in the unit of time
  motion.WeightedTension = this->Settings.Law.WeightedTension;
  const bool isAutomatic = this->Settings.HasAutomaticAttraction();
  motion.Tension = isAutomatic ? 0.0 : given * FactorsPerStep;
  if (this->Settings.SmoothsParticles() && this->Settings.Law.Tension == 0.0)
  {
    const double r = 0.5 * this->Shapes.FindSpacing();
    motion.Tension = TensionOfSpacingAtNodes * FactorsPerStep * r * r;
  }
  band.StartOnNodes(0.0, domain.Bounds, motion, 1.0, this->Shapes.GetTarget());
  band.RestoreTargets(motion);
  if (band.IsEmpty())
  {
    this->Messages.Say("empty", NoSkinOnNodes);
  }
}

// Once the voxels are known.
Obstacle* MotionDriver::FindObstacle() const
{
  vtkImplicitFunction* function = this->Settings.Inputs.ObstacleFunction;
  const SurfaceDomain* domain = this->Shapes.FindDomain();
  if (!this->Solid && function && domain)
  {
    this->Solid = MakeObstacle(function, domain->VoxelSize, domain->Origin);
  }
  return this->Solid.get();
}

Motion MotionDriver::GetMotion(int step, bool hasParticles) const
{
  Motion motion = this->Settings.Law;
  const bool hasFluid = hasParticles && !motion.Paper;
  const SurfaceDomain* domain = this->Shapes.FindDomain();
  motion.CreateParts = motion.CreateParts && !motion.Paper && domain; // which tells the voxels
  motion.WeightedTension = motion.WeightedTension && hasFluid;
  motion.Transport = 0.0; // of what stands still
  motion.Integration = this->ChooseIntegration(false);
  motion.Solid = this->FindObstacle();
  motion.Box.Present = this->Settings.Bounded && domain;
  if (domain)
  {
    std::copy_n(domain->Bounds, 6, motion.Box.Bounds);
  }
  if (step >= 0 && this->StaysOnNodes())
  {
    motion.Attraction = motion.Tension = 0.0;
    motion.CreateParts = false;
  }
  const int last = this->Settings.GetNumberOfSteps() - 1;
  if (this->Settings.Inputs.TargetMoves && step >= 0 && last > 0)
  {
    // At the last step it is that of the way there.
    const double* steps = this->Settings.Inputs.Steps.data() + std::min(step, last - 1);
    const double length = this->Settings.TimeScale * (steps[1] - steps[0]);
    motion.Transport = hasFluid ? this->Settings.Law.Transport : 0.0;
    motion.Integration = this->ChooseIntegration(motion.Transport > 0.0);
    const bool isCarried =
      motion.Transport > 0.0 && motion.Integration == TimeIntegration::Implicit;
    motion.LongestStep = length / (isCarried ? SubstepsOfCarriedSurface : SubstepsOfMovingTarget);
    if (this->Settings.HasAutomaticAttraction())
    {
      motion.Attraction = FactorsPerStep / length;
    }
    if (hasFluid && this->Settings.HasAutomaticTension())
    {
      const double r = 0.5 * this->Shapes.FindSpacing();
      const double factor =
        this->MayUseNodes(motion, length) ? TensionOfSpacingAtNodes : TensionOfSpacing;
      motion.Tension = factor * motion.Attraction * r * r;
    }
    if (hasFluid && this->MayUseNodes(motion, length))
    {
      motion.Integration = TimeIntegration::Nodes;
    }
  }
  return motion;
}

bool MotionDriver::MayUseNodes(const Motion& motion, double length) const
{
  return this->Settings.UsesNodes() && motion.Attraction * length >= FewestFactorsOfNodes;
}

// Few long substeps suit what is carried, and are no part of the paper's scheme.
TimeIntegration MotionDriver::ChooseIntegration(bool isCarried) const
{
  const Motion& law = this->Settings.Law;
  const bool isPossible = law.Evaluation == TargetEvaluation::Shifted &&
    law.Gradient == GradientScheme::Upwind && !law.Paper;
  const IntegrationChoice choice = this->Settings.Integration;
  const bool isImplicit = choice == IntegrationChoice::Implicit ||
    (choice == IntegrationChoice::Automatic && isCarried && isPossible);
  return isImplicit ? TimeIntegration::Implicit : TimeIntegration::Explicit;
}

// On its way to the next step, if that is known.
void MotionDriver::PlaceTargetFrom(int step)
{
  this->Shapes.UseFramesFrom(step);
  MovingTarget* moving = this->Shapes.GetMovingTarget();
  if (moving && this->Settings.Inputs.TargetMoves)
  {
    const int next = this->Shapes.Has(step + 1) ? step + 1 : step;
    moving->MoveAlong(
      step, this->Settings.GetMotionTimeOf(step).Value, this->Settings.GetMotionTimeOf(next).Value);
  }
}

// Counts what was done before an exception too.
template <class Advance>
AdvanceReport MotionDriver::Count(const NarrowBand& band, Advance&& advance)
{
  const AdvanceReport before = band.GetWork();
  const auto count = [this, &band, &before]
  {
    this->Substeps += band.GetWork().Substeps - before.Substeps;
    this->TargetEvaluations += band.GetWork().TargetEvaluations - before.TargetEvaluations;
  };
  try
  {
    const AdvanceReport report = advance();
    count();
    return report;
  }
  catch (...)
  {
    count();
    throw;
  }
}

bool MotionDriver::AdvanceTo(
  NarrowBand& band, int step, MotionTime time, const ProgressFunction& progress)
{
  this->PlaceTargetFrom(step);
  const Motion motion = this->GetMotion(step);
  const bool wasEmpty = band.IsEmpty();
  if (wasEmpty && !this->MayCreateParts(motion))
  {
    return true;
  }
  if (this->Settings.UsesNodes() && motion.Integration != TimeIntegration::Nodes &&
    !this->StaysOnNodes())
  {
    this->Messages.Say("nodes", NoNodes);
  }
  this->Prepare(band);
  const AdvanceReport report =
    this->Count(band, [&] { return this->AdvanceOrArrive(band, step, time, motion, progress); });
  WarnOfMotion(report, { time, wasEmpty, this->MayCreateParts(motion) }, this->Messages);
  return !report.Aborted;
}

bool MotionDriver::MayCreateParts(const Motion& motion) const
{
  const bool knowsParts =
    this->Settings.ArrivesAfter({ 0.0 }) || this->Shapes.GetTarget().HasRegions();
  return motion.CreateParts && knowsParts;
}

AdvanceReport MotionDriver::AdvanceOrArrive(NarrowBand& band, int step, MotionTime time,
  const Motion& motion, const ProgressFunction& progress)
{
  if (!this->Settings.ArrivesAfter({ band.GetTime() }) || !this->Shapes.FindDomain())
  {
    return band.Advance(time.Value, motion, this->Shapes.GetTarget(), progress);
  }
  this->PrepareArrival(band, step, motion);
  return this->Arriving->Advance(
    band, time.Value, this->Settings.GetArrival().Value, motion, progress);
}

// What is left to go is found once for each step: so an interruption, or a request between two
// steps, does not change the way to the next one.
void MotionDriver::PrepareArrival(NarrowBand& band, int step, const Motion& motion)
{
  PotentialTarget& target = this->Shapes.GetTarget();
  if (MovingTarget* moving = this->Shapes.GetMovingTarget())
  {
    moving->Complete();
  }
  const double* bounds = this->Shapes.FindDomain()->Bounds;
  if (motion.CreateParts && band.GetTime() == 0.0)
  {
    CreateCores(band, motion, target, bounds);
  }
  const std::size_t number = this->Shapes.GetTargetNumber();
  if (!this->Arriving || this->ArrivingFrom != step || this->ArrivingAt != number)
  {
    this->Arriving = std::make_unique<Arrival>(band, target, bounds);
    this->ArrivingFrom = step;
    this->ArrivingAt = number;
  }
}

bool MotionDriver::AdvanceToSteadyState(
  NarrowBand& band, const ProgressFunction& progress, AdvanceReport& report)
{
  this->Prepare(band);
  const bool wasEmpty = band.IsEmpty();
  SteadyStateCriterion criterion = this->Settings.SteadyState;
  criterion.MaximumSubsteps -= std::min(band.GetWork().Substeps, criterion.MaximumSubsteps);
  const Motion motion = this->GetMotion(0);
  PotentialTarget& target = this->Shapes.GetTarget();
  report = this->Count(
    band, [&] { return band.AdvanceToSteadyState(motion, criterion, target, progress); });
  WarnOfMotion(
    report, { { band.GetTime() }, wasEmpty, this->MayCreateParts(motion) }, this->Messages);
  report.IsSteady = report.IsSteady || report.Vanished;
  if (!report.IsSteady && !report.Aborted)
  {
    WarnOfNoRest(this->Settings.SteadyState, report, this->Messages);
  }
  return !report.Aborted;
}

}
