#include "Simulation/MotionDriver.h"

#include "Base/Obstacle.h"
#include "Base/Tension.h"
#include "Simulation/MotionWarnings.h"
#include "Simulation/SurfaceStart.h"
#include "Targets/FunctionSampler.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

class vtkImplicitFunction;

namespace activesurface
{

namespace
{

// Returns the distance F / |grad F|, exact to first order. See MakeObstacle for |grad F| = 0.
double FindDistance(double value, const double gradient[3])
{
  const double slope = std::hypot(gradient[0], gradient[1], gradient[2]);
  const double far = value == 0.0 ? 0.0 : HUGE_VAL * value;
  return std::isfinite(slope) && slope > 0.0 ? value / slope : far;
}

// Makes an obstacle whose distances are those of FindDistance for an implicit function. Where the
// gradient vanishes or is not finite, the distance is infinite with the sign of F, or 0 if F is 0.
// origin: origin of the obstacle's points. The function must not change later.
std::unique_ptr<Obstacle> MakeObstacle(
  vtkImplicitFunction* function, double voxelSize, const std::array<double, 3>& origin)
{
  // Step of central differences, for functions without a gradient [voxels].
  constexpr double step = 0.125;
  const auto sampler = std::make_shared<const FunctionSampler>(function, step * voxelSize, origin);
  const auto distances = [sampler](std::size_t count, const double* points, double* results)
  {
    std::vector<double> gradients(3 * count);
    sampler->Sample(count, points, results, gradients.data());
    for (std::size_t i = 0; i < count; ++i)
    {
      results[i] = FindDistance(results[i], gradients.data() + 3 * i);
    }
  };
  return std::make_unique<Obstacle>(voxelSize, distances, sampler->IsThreadSafe(), origin);
}

// Least number of explicit substeps from one step to the next over a moving target. The target is
// evaluated at least this often in the interval, even if the surface is slow.
constexpr double SubstepsOfMovingTarget = 4.0;
// Automatic attraction: distances fall by a factor e^6 from one step to the next.
constexpr double FactorsPerStep = 6.0;
// Distance of the walls from the sides of a periodic box, as a fraction of the box's margin.
// Particles are repeated in the whole margin, so particles at the walls have all neighbours.
constexpr double ShareOfMargin = 0.5;
constexpr char NoNodes[] =
  " needs explicit substeps, in which the skin may lag behind the particles and is not smoothed "
  "over their spacing. Change this setting, or set TimeIntegration to EXPLICIT to accept this.";
constexpr char NoTensionAtStart[] =
  "The first frame is without the given Tension: its effect depends on the automatic Attraction, "
  "which follows from the time to the next frame. Set Attraction, too, or leave Tension automatic.";
constexpr char NoSkinOnNodes[] =
  "The target has no surface that the voxels can resolve, or walls or the obstacle exclude it, so "
  "there is no skin; check VoxelSize, BoundedDomain, ObstacleFunction, Tension and, for particles, "
  "their radii and strengths, KernelRadius and ParticleThreshold.";

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
  this->Shapes.CompleteTarget();
  const std::unique_ptr<PotentialTarget> shape = this->Shapes.MakeStart();
  this->Prepare(band);
  const Motion motion = this->GetMotion(-1);
  const bool isStarted =
    StartOn(band, { domain, motion.Box, motion.Solid, shape ? *shape : this->Shapes.GetTarget() },
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
    this->Shapes.IsOnNodes(0, 0);
}

// Returns true if the surface starts by the node scheme on a static target: the skin then stays as
// it started.
bool MotionDriver::StaysOnNodes() const
{
  return !this->Settings.Inputs.TargetMoves && this->StartsOnNodes();
}

// Returns a given Tension divided by the attraction in the first interval. Returns 0 if that
// attraction is 0 or unknown, and over moving particles if that attraction is automatic.
double MotionDriver::FindTensionAtStart(const Motion& motion) const
{
  if (!this->Settings.HasAutomaticAttraction() || !this->Settings.Inputs.TargetMoves)
  {
    return motion.Attraction > 0.0 ? motion.Tension / motion.Attraction : 0.0;
  }
  const bool isOnParticles = this->Shapes.HasParticles(0, 0);
  if (isOnParticles && motion.Tension > 0.0)
  {
    this->Messages.Say("tension at start", NoTensionAtStart);
  }
  const bool isKnown = !isOnParticles && this->Settings.GetNumberOfSteps() > 1;
  return isKnown ? motion.Tension * this->Settings.GetMotionTimeOf(1).Value / FactorsPerStep : 0.0;
}

// Starts as after one time step with the automatic attraction, so that the first frame is as smooth
// as later frames. This step's duration may be unknown yet. An automatic tension is proportional to
// the attraction, so the tension's effect does not depend on the duration.
void MotionDriver::StartOnNodes(NarrowBand& band, const SurfaceDomain& domain)
{
  Motion motion = this->GetMotion(-1);
  const double given = this->FindTensionAtStart(motion);
  motion.Attraction = FactorsPerStep; // per unit of time; the duration below is 1
  motion.Tension = given * FactorsPerStep;
  this->UseNodes(0, FactorsPerStep, motion);
  this->HoldLabelVolume(0, 0.0, motion);
  band.StartOnNodes(0.0, domain.Bounds, motion, 1.0, this->Shapes.GetTarget());
  band.RestoreTargets(motion);
  if (band.IsEmpty())
  {
    this->Messages.Say("empty", NoSkinOnNodes);
  }
}

// Returns null without an obstacle, or before there is a domain.
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

Walls MotionDriver::MakeWalls(double beyond) const
{
  constexpr double farAway = 1e300;
  const PeriodicBox periodic = this->Shapes.GetBox();
  const SurfaceDomain* domain = this->Shapes.FindDomain();
  const bool isBounded = this->Settings.Bounded && domain;
  Walls walls;
  walls.Present = isBounded || periodic.Any();
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    double& low = walls.Bounds[2 * axis];
    double& high = walls.Bounds[2 * axis + 1];
    low = isBounded ? domain->Bounds[2 * axis] : -farAway;
    high = isBounded ? domain->Bounds[2 * axis + 1] : farAway;
    if (periodic.Length[axis] > 0.0)
    {
      low = periodic.Low[axis] - beyond;
      high = periodic.Low[axis] + periodic.Length[axis] + beyond;
    }
  }
  return walls;
}

Motion MotionDriver::GetMotion(int step, bool isOnNodes) const
{
  Motion motion = this->Settings.GetLaw();
  const SurfaceDomain* domain = this->Shapes.FindDomain();
  motion.CreateParts = motion.CreateParts && !motion.Paper && domain; // needs the voxel size
  motion.WeightedTension = false;
  motion.Transport = 0.0;
  motion.Solid = this->FindObstacle();
  motion.Period = this->Shapes.GetBox();
  motion.Box = this->MakeWalls(ShareOfMargin * this->Shapes.FindMargin(std::max(step, 0)));
  if (step >= 0 && this->StaysOnNodes())
  {
    motion.Attraction = motion.Tension = 0.0;
    motion.CreateParts = false;
  }
  const int last = this->Settings.GetNumberOfSteps() - 1;
  if (this->Settings.Inputs.TargetMoves && step >= 0 && last > 0)
  {
    // The last step has no interval after it, so the interval before it is used.
    const double* steps = this->Settings.Inputs.Steps.data() + std::min(step, last - 1);
    const double length = this->Settings.TimeScale * (steps[1] - steps[0]);
    motion.LongestStep = length / SubstepsOfMovingTarget;
    if (this->Settings.HasAutomaticAttraction())
    {
      motion.Attraction = FactorsPerStep / length;
    }
    if (isOnNodes && motion.Attraction * length >= SurfaceSettings::FewestFactorsOfNodes)
    {
      this->UseNodes(step, motion.Attraction, motion);
    }
  }
  return motion;
}

// attraction: rate to which an automatic tension is proportional.
void MotionDriver::UseNodes(int step, double attraction, Motion& motion) const
{
  const Motion& chosen = this->Settings.Parameters;
  const double pixel = this->Shapes.FindLabelPixel(step, step + 1);
  motion.Integration = TimeIntegration::Nodes;
  if (pixel > 0.0)
  {
    if (this->Settings.Tension == Automatic)
    {
      motion.Tension = AutomaticTensionOfLabels(attraction, pixel);
    }
    return;
  }
  motion.WeightedTension = chosen.WeightedTension;
  motion.Transport = chosen.Transport;
  if (this->Settings.HasAutomaticTension())
  {
    motion.Tension = AutomaticTension(attraction, this->Shapes.FindSpacing());
  }
}

// In the node scheme, conserves the labels' volume unless there is a control, wall or obstacle.
void MotionDriver::HoldLabelVolume(int step, double fraction, Motion& motion) const
{
  const double volume = this->Shapes.FindLabelVolume(step, fraction);
  if (motion.Integration == TimeIntegration::Nodes && volume > 0.0 && !motion.Box.Present &&
    !motion.Solid && motion.VolumeControl == Control::None && motion.AreaControl == Control::None)
  {
    motion.VolumeControl = Control::Exact;
    motion.TargetVolume = volume;
  }
}

// Places the target in the interval from a step to the next one, or at the step itself if the frame
// of the next step is not stored.
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

// Adds the work of `advance` to the counters, even if `advance` throws.
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
  Motion motion = this->GetMotion(step);
  if (const MovingTarget* moving = this->Shapes.GetMovingTarget())
  {
    this->HoldLabelVolume(step, moving->FindFraction(time.Value), motion);
  }
  const bool wasEmpty = band.IsEmpty();
  if (wasEmpty && !this->MayCreateParts(motion))
  {
    return true;
  }
  this->WarnOfSubsteps(step, motion);
  this->Prepare(band);
  const AdvanceReport report =
    this->Count(band, [&] { return this->AdvanceOrArrive(band, step, time, motion, progress); });
  WarnOfMotion(report, { time, wasEmpty, this->MayCreateParts(motion) }, this->Messages);
  return !report.Aborted;
}

void MotionDriver::WarnOfSubsteps(int step, const Motion& motion)
{
  const char* found = this->Settings.FindWhatNeedsSubsteps();
  const char* reason =
    found ? found : "Attraction below 2 / (TimeScale * interval between time steps)";
  const bool isAsked =
    this->Settings.Integration == IntegrationChoice::Explicit || this->Settings.Parameters.Paper;
  if (motion.Integration != TimeIntegration::Nodes && !isAsked &&
    this->Settings.Inputs.TargetMoves && this->Shapes.HasParticles(step, step + 1))
  {
    this->Messages.Say("substeps", reason + std::string(NoNodes));
  }
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

// Computes the distances from skin to target once for each step, so that an interruption, or a
// request between two steps, does not change the motion to the next step.
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
  if (!report.Aborted)
  {
    WarnOfNoRest(this->Settings.SteadyState, report, this->Messages);
  }
  return !report.Aborted;
}

}
