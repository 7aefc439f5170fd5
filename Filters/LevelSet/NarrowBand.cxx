#include "NarrowBand.h"

#include "BandState.h"
#include "Base/ReportSum.h"
#include "Base/StaticShutdown.h"
#include "Start/InitialShape.h"
#include "Start/LatticeBox.h"
#include "Start/NearbyStart.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <stdexcept>
#include <tbb/task_arena.h>
#include <utility>

namespace activesurface
{
namespace
{

/** Returns the arena of the calling thread for at most `threads` threads; 0: all. */
tbb::task_arena& FindArena(int threads);

/**
 * Returns an arena that is kept for each thread and each number of workers: TBB (2021.8) leaks 7 kB
 * for each deleted arena that workers had joined.
 */
tbb::task_arena& FindArena(int threads)
{
  thread_local std::map<int, tbb::task_arena> arenas;
  const int concurrency = threads > 0 ? threads : tbb::task_arena::automatic;
  return arenas.try_emplace(concurrency, concurrency).first->second;
}

}

NarrowBand::NarrowBand(double voxelSize)
  : State(new BandState)
{
  if (!std::isfinite(voxelSize) || !(voxelSize > 0.0))
  {
    std::ostringstream text;
    text << "VoxelSize must be a finite number > 0, not " << voxelSize << ".";
    throw std::invalid_argument(text.str());
  }
  openvdb::initialize();
  this->State->VoxelSize = voxelSize;
  this->State->MakeEmpty();
}

NarrowBand::~NarrowBand()
{
  ReleaseUnlessExiting(std::move(this->State->Potential));
}

void NarrowBand::SetNumberOfThreads(int threads)
{
  constexpr int most = 1024; // TBB allocates memory for each thread
  this->State->Threads = std::min(std::max(threads, 0), most);
}

void NarrowBand::SetMaximumNumberOfActiveVoxels(std::size_t maximum)
{
  this->State->Maximum = maximum;
}

bool NarrowBand::Start(double time, const double bounds[6], const InitialFunction& function,
  const ProgressFunction& progress)
{
  BandState& members = *this->State;
  members.Reset(time, bounds);
  bool finished = false;
  this->Run(
    [&]
    {
      const auto make = function.Surface.ForEach ? MakeNearbyPotential
        : function.ForEachRegion                 ? MakeSparsePotential
                                                 : MakeInitialPotential;
      openvdb::FloatTree::Ptr tree =
        make(members.VoxelSize, bounds, function, members.Maximum, progress);
      if (!tree)
      {
        return;
      }
      members.Restore(tree);
      members.StartMeasure = members.Measure();
      finished = true;
    });
  if (finished && this->GetNumberOfActiveNodes() > members.Maximum)
  {
    members.MakeEmpty();
    throw std::runtime_error(
      "The initial surface needs more active voxels than MaximumNumberOfActiveVoxels = " +
      std::to_string(members.Maximum) + "; enlarge VoxelSize or raise the maximum.");
  }
  return finished;
}

void NarrowBand::StartEmpty(double time, const double bounds[6])
{
  this->State->Reset(time, bounds);
}

void NarrowBand::StartOnNodes(
  double time, const double bounds[6], const Motion& motion, double duration, Target& target)
{
  BandState& members = *this->State;
  CheckMotion(motion);
  FindLatticeBox(members.VoxelSize, bounds); // throws for bounds that do not fit into a lattice
  members.Reset(time, bounds);
  this->Run([&] { members.StartOnNodes(motion, duration, target); });
}

std::size_t NarrowBand::CreateParts(const Motion& motion, const Target& target)
{
  BandState& members = *this->State;
  AdvanceReport report;
  this->Run(
    [&]
    {
      members.Begin(motion);
      members.CreateParts(motion, target, report);
      members.FinishFrame();
    });
  AddWork(members.Work, report);
  return report.CreatedParts;
}

void NarrowBand::Confine(const Walls& walls, Obstacle* obstacle)
{
  this->Run([&] { this->State->Confine(walls, obstacle); });
}

void NarrowBand::RestoreTargets(const Motion& motion)
{
  const bool hasVolume = motion.VolumeControl == Control::Exact && motion.TargetVolume > 0.0;
  const bool hasArea = motion.AreaControl == Control::Exact && motion.TargetArea > 0.0;
  if (this->IsEmpty() || !(hasVolume || hasArea))
  {
    return;
  }
  BandState& members = *this->State;
  const auto missing = [&]
  {
    const SkinMeasure now = members.Measure();
    return hasVolume ? motion.TargetVolume - now.Volume : motion.TargetArea - now.Area;
  };
  this->Run(
    [&]
    {
      members.AddGhosts();
      // A pass moves the surface by a limited distance. The loop ends when a pass lowers the error
      // by less than 1 %.
      double before = HUGE_VAL;
      for (double left = missing(); std::fabs(left) < 0.99 * before; left = missing())
      {
        before = std::fabs(left);
        members.RestoreControlled(motion);
      }
      members.FinishFrame();
      members.StartMeasure = members.Measure();
    });
}

namespace
{

/** Returns true if an empty surface may get parts. */
bool MayBegin(const Motion& motion, const Target& target)
{
  return motion.CreateParts && target.HasRegions() && motion.Attraction > 0.0;
}

/** Calls substep() until substep() returns false, or the surface has vanished and cannot reappear.
 * Then finishes the frame, also after an exception. */
template <class Substep>
void GoOn(const NarrowBand& band, BandState& members, bool mayBegin, const AdvanceReport& report,
  Substep&& substep)
{
  const auto finish = [&]
  {
    members.FinishFrame();
    AddWork(members.Work, report);
  };
  band.Run(
    [&]
    {
      try
      {
        for (bool goesOn = true; goesOn && (mayBegin || members.Crossings > 0);)
        {
          goesOn = substep();
        }
      }
      catch (...)
      {
        finish();
        throw;
      }
      finish();
    });
}

}

AdvanceReport NarrowBand::Advance(
  double time, const Motion& motion, Target& target, const ProgressFunction& progress)
{
  BandState& members = *this->State;
  CheckMotion(motion);
  if (!(time >= members.Time))
  {
    std::ostringstream text;
    text << "The surface is at time " << members.Time << " and cannot go back to " << time
         << "; advance to a later time.";
    throw std::invalid_argument(text.str());
  }
  AdvanceReport report;
  const double begin = members.Time;
  this->Run([&] { members.Begin(motion); });
  GoOn(*this, members, MayBegin(motion, target), report,
    [&]
    {
      if (!(members.Time < time))
      {
        return false;
      }
      report.Aborted = progress && !progress((members.Time - begin) / (time - begin));
      if (!report.Aborted)
      {
        members.Step(time, motion, target, report);
      }
      return !report.Aborted;
    });
  members.Time = report.Aborted ? members.Time : time;
  report.Vanished = members.Crossings == 0;
  return report;
}

AdvanceReport NarrowBand::AdvanceToSteadyState(const Motion& motion,
  const SteadyStateCriterion& criterion, Target& target, const ProgressFunction& progress)
{
  BandState& members = *this->State;
  CheckMotion(motion);
  if (!(criterion.Tolerance >= 0.0))
  {
    throw std::invalid_argument("RestTolerance must be a number >= 0.");
  }
  AdvanceReport report;
  this->Run([&] { members.Begin(motion); });
  GoOn(*this, members, MayBegin(motion, target), report,
    [&]
    {
      const double done =
        double(report.Substeps) / std::max(1.0, double(criterion.MaximumSubsteps));
      report.Aborted = progress && !progress(std::min(done, 1.0));
      if (report.Aborted || report.Substeps >= criterion.MaximumSubsteps)
      {
        return false;
      }
      const std::size_t created = report.CreatedParts;
      members.StepAndTrace(motion, target, report);
      const bool isStill = report.SurfaceSpeed <= criterion.Tolerance;
      members.Window.Observe(members.Leaves, members.Time, motion.Attraction);
      report.MovingShare = isStill ? 0.0 : members.Window.GetShare();
      report.MovingDistance = isStill ? 0.0 : members.Window.GetMean();
      report.IsSteady = report.CreatedParts == created &&
        (isStill || (criterion.Tolerance > 0.0 && members.Window.IsSteady()));
      return !report.IsSteady;
    });
  if (!report.Aborted)
  {
    members.NoPartsBefore = BandState::AnyTime;
  }
  report.Vanished = members.Crossings == 0;
  return report;
}

void NarrowBand::Run(const std::function<void()>& function) const
{
  FindArena(this->State->Threads).execute(function);
}

const AdvanceReport& NarrowBand::GetWork() const
{
  return this->State->Work;
}

void NarrowBand::ForgetWork()
{
  this->State->Work = AdvanceReport();
}

double NarrowBand::GetArea() const
{
  SkinMeasure skin;
  this->Run([&] { skin = this->State->Measure(); });
  return skin.Area;
}

double NarrowBand::GetVolume() const
{
  SkinMeasure skin;
  this->Run([&] { skin = this->State->Measure(); });
  return skin.Volume;
}

double NarrowBand::GetStartArea() const
{
  return this->State->StartMeasure.Area;
}

double NarrowBand::GetStartVolume() const
{
  return this->State->StartMeasure.Volume;
}

double NarrowBand::GetVoxelSize() const
{
  return this->State->VoxelSize;
}

double NarrowBand::GetTime() const
{
  return this->State->Time;
}

bool NarrowBand::IsEmpty() const
{
  return this->State->Crossings == 0;
}

std::size_t NarrowBand::GetNumberOfActiveNodes() const
{
  std::size_t count = 0;
  this->Run([&] { count = this->State->CountActive(); });
  return count;
}

std::size_t NarrowBand::GetNumberOfGhosts() const
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < this->State->Leaves.Size(); ++i)
  {
    const LeafSummary& leaf = this->State->Leaves.SummaryOf(i);
    if (!leaf.IsForeign)
    {
      count += this->State->Leaves[i].UpToLayer[LastLayer].Count() - leaf.ActiveNodes;
    }
  }
  return count;
}

const LeafTable& NarrowBand::GetLeaves() const
{
  return this->State->Leaves;
}

}
