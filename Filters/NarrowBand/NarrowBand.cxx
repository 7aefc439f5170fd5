#include "NarrowBand.h"

#include "GhostFill.h"
#include "InitialShape.h"
#include "Layers.h"
#include "SamplePoints.h"
#include "StepForward.h"
#include "SubstepBuffers.h"
#include "TargetSpeed.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace activesurface
{

namespace
{

/** How the target limits the step: largest speed [length/time], largest |dF/dn| met. */
struct TargetLimits
{
  double Speed = 0.0;
  double Slope = 0.0;
};

}

struct NarrowBand::State
{
  double VoxelSize = 1.0;
  double Time = 0.0;
  int Threads = 0;
  std::size_t Maximum = std::numeric_limits<std::size_t>::max();
  openvdb::FloatGrid::Ptr Potential;
  LeafTable Leaves;
  std::size_t Crossings = 0;
  SubstepBuffers Buffers;

  void MakeEmpty();
  void TakeTree(const openvdb::FloatTree::Ptr& tree);
  TargetLimits SampleTarget(const Motion& motion, Target& target, AdvanceReport& report);
  void Step(double end, const Motion& motion, Target& target, AdvanceReport& report);
  void RebuildBand();
  void FinishFrame();
  std::size_t CountActive() const;
  void CheckSize() const;
};

void NarrowBand::State::MakeEmpty()
{
  this->Potential = openvdb::FloatGrid::create(NarrowBand::Far);
  this->Leaves.Rebuild(this->Potential->tree());
  this->Crossings = 0;
}

void NarrowBand::State::TakeTree(const openvdb::FloatTree::Ptr& tree)
{
  this->Potential->setTree(tree);
  this->Leaves.Rebuild(*tree);
  ReadSigns(this->Leaves);
  RebuildLayers(this->Leaves, *tree);
  this->Crossings = NumberCrossings(this->Leaves);
}

std::size_t NarrowBand::State::CountActive() const
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < this->Leaves.Size(); ++i)
  {
    count += this->Leaves[i].Active.Count();
  }
  return count;
}

void NarrowBand::State::CheckSize() const
{
  const std::size_t count = this->CountActive();
  if (count > this->Maximum)
  {
    std::ostringstream text;
    text << "The band has grown to " << count << " active voxels, more than "
         << "MaximumNumberOfActiveVoxels = " << this->Maximum
         << "; enlarge VoxelSize, check that the target is bounded, or raise the maximum.";
    throw std::runtime_error(text.str());
  }
}

namespace
{

/** Rate at which tracking the target limits the time step. Advection by minmod-limited differences
 * is stable (total variation does not grow) up to 2/3 of a voxel in the 1-norm, which is at most
 * sqrt 3 times the speed. */
double TrackingRate(const Motion& motion, double voxelSize, const TargetLimits& limits)
{
  const double advection = 1.5 * std::sqrt(3.0);
  return advection * limits.Speed / voxelSize + motion.Attraction * limits.Slope;
}

/** The rates of all that limits the time step add up; taking the largest alone lets the skin
 * tremble at rest. */
double StableStep(const Motion& motion, double voxelSize, double trackingRate)
{
  const double rate = trackingRate + 4.0 * std::fabs(motion.Tension) / (voxelSize * voxelSize);
  return rate > 0.0 ? motion.CFL / rate : std::numeric_limits<double>::infinity();
}

/** Relaxation is paid by tracking alone: at a fixed rate it would bias tension. It uses the same
 * one-sided differences as advection (voxels per step), and unless both together stay below 1/2
 * they amplify each other. */
double RelaxationFor(double tracking, double advection)
{
  return std::max(0.0, std::min(0.3 * std::min(1.0, tracking), 0.5 - advection));
}

void CheckStep(double step, double remaining)
{
  constexpr double mostSubsteps = 1e6;
  if (!(step * mostSubsteps > remaining))
  {
    std::ostringstream text;
    text << "The stable time step is " << step << ", more than a million substeps for the "
         << remaining << " to go; lower Attraction or Tension, enlarge VoxelSize, or check the "
         << "scale of the target function (NormalizeTarget).";
    throw std::runtime_error(text.str());
  }
}

void CheckMotion(const Motion& motion)
{
  if (!std::isfinite(motion.Attraction) || motion.Attraction < 0.0)
  {
    throw std::invalid_argument("Attraction must be a finite number >= 0.");
  }
  if (!std::isfinite(motion.Tension))
  {
    throw std::invalid_argument("Tension must be a finite number.");
  }
  if (!(motion.CFL > 0.0) || !std::isfinite(motion.CFL))
  {
    throw std::invalid_argument("CFL must be a finite number > 0.");
  }
}

/** The potential is doubled or halved when most of its slopes have left 1/sqrt 2 .. sqrt 2. */
float ScaleFor(const SlopeCounts& counts)
{
  return 2 * counts.Flat > counts.Nodes ? 2.f : 2 * counts.Steep > counts.Nodes ? .5f : 1.f;
}

}

TargetLimits NarrowBand::State::SampleTarget(
  const Motion& motion, Target& target, AdvanceReport& report)
{
  if (!(motion.Attraction > 0.0))
  {
    return {};
  }
  target.MoveTo(this->Time);
  FindSamplePoints(this->Leaves, this->VoxelSize, this->Crossings, this->Buffers.Points);
  const TargetSamples samples = EvaluateTarget(target, this->Crossings, this->Buffers);
  const double speed = FindTargetSpeed(this->Leaves, motion.Attraction, this->Buffers);
  report.TargetEvaluations += samples.Count;
  report.DroppedSamples += samples.Dropped;
  report.MaxSpeed = std::max(report.MaxSpeed, speed);
  return { speed, samples.LargestSlope };
}

void NarrowBand::State::Step(
  double end, const Motion& motion, Target& target, AdvanceReport& report)
{
  const TargetLimits limits = this->SampleTarget(motion, target, report);
  const double tracking = TrackingRate(motion, this->VoxelSize, limits);
  const double stable = StableStep(motion, this->VoxelSize, tracking);
  const double remaining = end - this->Time;
  CheckStep(stable, remaining);
  const double step = std::min(stable, remaining);

  StepCoefficients coefficients;
  coefficients.Moves = motion.Attraction > 0.0;
  coefficients.Advection = static_cast<float>(step / this->VoxelSize);
  coefficients.Tension =
    static_cast<float>(step * motion.Tension / (this->VoxelSize * this->VoxelSize));
  coefficients.Relaxation =
    static_cast<float>(RelaxationFor(step * tracking, step * limits.Speed / this->VoxelSize));
  const SlopeCounts slopes = StepForward(this->Leaves, coefficients, this->Buffers);
  this->RebuildBand();
  const float scale = ScaleFor(slopes);
  if (scale != 1.f)
  {
    ScalePotential(this->Leaves, scale);
  }
  this->Time = step < remaining ? this->Time + step : end;
  ++report.Substeps;
  this->CheckSize();
}

void NarrowBand::State::RebuildBand()
{
  RebuildLayers(this->Leaves, this->Potential->tree());
  FillGhosts(this->Leaves);
  std::size_t empty = 0;
  for (std::size_t i = 0; i < this->Leaves.Size(); ++i)
  {
    empty += !this->Leaves[i].Upto[LastLayer].Any();
  }
  if (8 * empty > this->Leaves.Size())
  {
    DropEmptyLeaves(this->Leaves, this->Potential->tree());
  }
  this->Crossings = NumberCrossings(this->Leaves);
}

void NarrowBand::State::FinishFrame()
{
  DropEmptyLeaves(this->Leaves, this->Potential->tree());
  NumberCrossings(this->Leaves);
  WriteActiveMasks(this->Leaves);
}

NarrowBand::NarrowBand(double voxelSize)
  : Members(new State)
{
  if (!std::isfinite(voxelSize) || !(voxelSize > 0.0))
  {
    std::ostringstream text;
    text << "VoxelSize must be a finite number > 0, not " << voxelSize << ".";
    throw std::invalid_argument(text.str());
  }
  openvdb::initialize();
  this->Members->VoxelSize = voxelSize;
  this->Members->MakeEmpty();
}

NarrowBand::~NarrowBand() = default;

std::unique_ptr<NarrowBand> NarrowBand::Clone() const
{
  auto copy = std::make_unique<NarrowBand>(this->Members->VoxelSize);
  State& members = *copy->Members;
  members.Time = this->Members->Time;
  members.Threads = this->Members->Threads;
  members.Maximum = this->Members->Maximum;
  copy->Run([&]
    { members.TakeTree(std::make_shared<openvdb::FloatTree>(this->Members->Potential->tree())); });
  return copy;
}

void NarrowBand::SetNumberOfThreads(int threads)
{
  constexpr int most = 1024; // TBB takes memory for each
  this->Members->Threads = std::min(std::max(threads, 0), most);
}

void NarrowBand::SetMaximumNumberOfActiveVoxels(std::size_t maximum)
{
  this->Members->Maximum = maximum;
}

bool NarrowBand::Start(double time, const double bounds[6], const InitialFunction& function,
  const ProgressFunction& progress)
{
  State& members = *this->Members;
  members.MakeEmpty();
  members.Time = time;
  bool finished = false;
  this->Run(
    [&]
    {
      openvdb::FloatTree::Ptr tree =
        MakeInitialPotential(members.VoxelSize, bounds, function, members.Maximum, progress);
      if (!tree)
      {
        return;
      }
      members.TakeTree(tree);
      for (std::size_t i = 0; i < members.Leaves.Size(); ++i)
      {
        members.Leaves[i].Advanced = LeafMask::All();
      }
      FillGhosts(members.Leaves);
      members.FinishFrame();
      finished = true;
    });
  if (finished && members.CountActive() > members.Maximum)
  {
    members.MakeEmpty();
    throw std::runtime_error(
      "The initial surface needs more active voxels than MaximumNumberOfActiveVoxels; enlarge "
      "VoxelSize or raise the maximum.");
  }
  return finished;
}

AdvanceReport NarrowBand::Advance(
  double time, const Motion& motion, Target& target, const ProgressFunction& progress)
{
  State& members = *this->Members;
  CheckMotion(motion);
  if (!(time >= members.Time))
  {
    std::ostringstream text;
    text << "The surface is at time " << members.Time << " and cannot go back to " << time << ".";
    throw std::invalid_argument(text.str());
  }
  AdvanceReport report;
  const double begin = members.Time;
  this->Run(
    [&]
    {
      try
      {
        while (members.Time < time && members.Crossings > 0 && !report.Aborted)
        {
          report.Aborted = progress && !progress((members.Time - begin) / (time - begin));
          if (!report.Aborted)
          {
            members.Step(time, motion, target, report);
          }
        }
      }
      catch (...)
      {
        members.FinishFrame();
        throw;
      }
      members.FinishFrame();
    });
  members.Time = report.Aborted ? members.Time : time;
  report.Vanished = members.Crossings == 0;
  return report;
}

void NarrowBand::Run(const std::function<void()>& function) const
{
  const int threads = this->Members->Threads;
  tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
  arena.execute(function);
}

double NarrowBand::GetVoxelSize() const
{
  return this->Members->VoxelSize;
}

double NarrowBand::GetTime() const
{
  return this->Members->Time;
}

bool NarrowBand::IsEmpty() const
{
  return this->Members->Crossings == 0;
}

std::size_t NarrowBand::GetNumberOfActiveNodes() const
{
  return this->Members->CountActive();
}

std::size_t NarrowBand::GetNumberOfGhosts() const
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < this->Members->Leaves.Size(); ++i)
  {
    count += this->Members->Leaves[i].Upto[LastLayer].Count();
  }
  return count - this->Members->CountActive();
}

openvdb::FloatGrid::ConstPtr NarrowBand::GetPotential() const
{
  return this->Members->Potential;
}

const LeafTable& NarrowBand::GetLeaves() const
{
  return this->Members->Leaves;
}

}
