#include "BandState.h"

#include "Front/ConvergedLeaves.h"
#include "Front/ExactControl.h"
#include "Front/FollowTarget.h"
#include "Front/StepForward.h"
#include "Front/TargetSpeed.h"
#include "Front/WalledTarget.h"
#include "Leaves/GhostFill.h"
#include "Leaves/Layers.h"
#include "Start/CreateParts.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace activesurface
{

/** One substep: its limits and its result. */
struct BandState::Move
{
  double End = std::numeric_limits<double>::infinity(); // time
  bool MaySkip = true;

  PenaltyForce Force;
  double Step = 0.0; // time
  bool IsSkipped = false;
};

namespace
{

/** ControlledBand::Rounds after a frame of the node scheme, which may replace many explicit
 * substeps. */
constexpr int RoundsOfLongSteps = 8;

bool HasPenalty(const Motion& motion)
{
  return motion.AreaControl == Control::Penalty || motion.VolumeControl == Control::Penalty;
}

}

void BandState::Begin(const Motion& motion)
{
  CheckSize(this->CountActive(), this->Maximum);
  if (motion.Integration == TimeIntegration::Explicit)
  {
    this->AddGhosts();
  }
  this->SwitchScheme(motion);
  ForgetSpeeds(this->Leaves); // the target may have been replaced
}

void BandState::SwitchScheme(const Motion& motion)
{
  if (motion.Paper == this->Paper)
  {
    return;
  }
  this->Paper = motion.Paper;
  this->Set.ChooseAll(this->Leaves);
  this->Leaves.SetBackground(this->GetBackground());
  BeginScheme(this->Leaves, this->Paper);
  this->RebuildBand(this->Set);
}

SkinMeasure BandState::Measure() const
{
  const SkinMeasure skin = this->Part ? this->Part->Measure : MeasureSkin(this->Leaves);
  const double square = this->VoxelSize * this->VoxelSize;
  return { skin.Area * square, skin.Volume * square * this->VoxelSize };
}

void BandState::CreateParts(const Motion& motion, const Target& target, AdvanceReport& report)
{
  const GrowingBand band{ this->Leaves, this->Set, this->Potential->tree(), this->VoxelSize,
    this->Maximum, this->Backup };
  if (activesurface::CreateParts(band, motion, target, report))
  {
    this->RebuildBand(this->Set);
  }
}

TargetLimits BandState::FollowTarget(
  const Motion& motion, Target& target, AdvanceReport& report, Move& move)
{
  if (!HasTargetSpeed(motion))
  {
    this->Set.ChooseAll(this->Leaves);
    return {};
  }
  target.MoveTo(this->Time);
  if (motion.CreateParts && target.HasRegions() && this->Time >= this->NoPartsBefore)
  {
    this->CreateParts(motion, target, report);
  }
  const TargetLimits limits =
    activesurface::FollowTarget(this->GetFollower(), motion, move.MaySkip, target, report);
  move.IsSkipped = this->Set.Active.empty();
  return limits;
}

/** Restores the band of the backup, if there is one. */
void BandState::Restore()
{
  if (const auto before = this->Backup.Get())
  {
    this->Leaves = LeafTable(); // contains data of the failed substep
    this->Restore(before);
  }
}

FollowingBand BandState::GetFollower()
{
  return { this->Leaves, this->Potential->tree(), this->VoxelSize, this->Set, this->Buffers };
}

PenaltyForce BandState::FindForce(const Motion& motion) const
{
  return HasPenalty(motion) && this->Crossings > 0
    ? FindPenalty(motion, this->Measure(), this->StartMeasure)
    : PenaltyForce();
}

void BandState::MakeDefaultStep(const Motion& motion, const TargetLimits& limits, Move& move)
{
  const double size = this->VoxelSize;
  const double tracking = TrackingRate(motion, size, limits);
  const double step = move.Step;
  StepCoefficients coefficients;
  coefficients.HasTargetSpeed = HasTargetSpeed(motion);
  coefficients.Central = motion.Gradient == GradientScheme::Central;
  coefficients.Uniform = static_cast<float>(move.Force.Speed);
  coefficients.Advection = AdvectionFactor(step, size);
  coefficients.Tension = static_cast<float>(step * motion.Tension / (size * size));
  const double speed = limits.Speed + std::fabs(move.Force.Speed);
  coefficients.Relaxation = static_cast<float>(RelaxationFor(step * tracking, step * speed / size));
  ExtendToActiveNodes(this->GetFollower(), motion);
  const GradientCounts gradients =
    StepForward(this->Leaves, this->Set, coefficients, this->Buffers);
  CheckBounded(gradients.Unbounded, this->Time);
  ClampToBounds({ motion.Box, motion.Solid, size }, this->Leaves, this->Set, this->Buffers);
  CommitStep(this->Leaves, this->Set, this->Buffers);
  this->RebuildBand(this->Set);
  const float scale = gradients.GetScale();
  if (scale != 1.f)
  {
    ScalePotential(this->Leaves, scale);
  }
  this->RestoreControlled(motion);
}

void BandState::MakePaperStep(const Motion& motion, Move& move)
{
  StepPaper(this->Leaves, AdvectionFactor(move.Step, this->VoxelSize), this->Buffers);
  ClampToBounds(
    { motion.Box, motion.Solid, this->VoxelSize }, this->Leaves, this->Set, this->Buffers);
  CommitStep(this->Leaves, this->Set, this->Buffers);
  this->RebuildBand(this->Set);
  this->RestoreControlled(motion);
}

void BandState::RestoreControlled(const Motion& motion)
{
  const double square = this->VoxelSize * this->VoxelSize;
  const ControlledBand band{ this->Leaves, this->Set, this->Buffers,
    [this](ActiveSet& set) { this->RebuildBand(set); }, motion.Box, motion.Solid, this->VoxelSize,
    motion.Integration == TimeIntegration::Explicit ? 1 : RoundsOfLongSteps };
  if (motion.VolumeControl == Control::Exact)
  {
    RestoreVolume(band, HeldVolume(motion, this->StartMeasure) / (square * this->VoxelSize));
  }
  else if (motion.AreaControl == Control::Exact)
  {
    RestoreArea(band, HeldArea(motion, this->StartMeasure) / square);
  }
}

void BandState::MakeStep(const Motion& motion, Target& target, AdvanceReport& report, Move& move)
{
  this->Backup.Forget();
  try
  {
    this->TryStep(motion, target, report, move);
  }
  catch (...)
  {
    this->Restore();
    throw;
  }
}

void BandState::TryStep(const Motion& motion, Target& target, AdvanceReport& report, Move& move)
{
  CheckObstacle(this->Leaves, motion.Solid);
  WalledTarget walled(target, motion.Box, motion.Solid);
  const TargetLimits limits =
    this->FollowTarget(motion, walled.IsCut() ? walled : target, report, move);
  const bool pullsInVain = PullsInVain(motion, this->Buffers);
  move.Force = this->FindForce(motion);
  double stable = this->Crossings > 0 ? StableStep(motion, this->VoxelSize, limits, move.Force)
                                      : std::numeric_limits<double>::infinity();
  move.IsSkipped = move.IsSkipped || !std::isfinite(stable);
  if (motion.Paper)
  {
    const PaperLimits whole = FindPaperSpeed(this->Leaves, motion.Attraction > 0.0,
      move.Force.Speed, motion.Tension / this->VoxelSize, this->Buffers);
    stable = motion.CFL * PaperTimeStep(whole, motion.Tension, this->VoxelSize, this->BoxSize);
    move.IsSkipped = !std::isfinite(stable);
  }
  stable = std::min(stable, motion.LongestStep);
  CheckStep(stable, this->VoxelSize, move.End - this->Time);
  move.Step = std::min(stable, move.End - this->Time);
  if (move.IsSkipped)
  {
    ++report.SkippedSubsteps;
    return;
  }
  if (motion.Paper)
  {
    this->MakePaperStep(motion, move);
  }
  else
  {
    this->MakeDefaultStep(motion, limits, move);
  }
  if (HasPenalty(motion) && this->Crossings == 0)
  {
    this->NoPartsBefore = move.End;
  }
  ++report.Substeps;
  report.UniformPulls += pullsInVain ? 1 : 0;
}

void BandState::Step(double end, const Motion& motion, Target& target, AdvanceReport& report)
{
  if (motion.Integration == TimeIntegration::Nodes)
  {
    this->AdvanceOnNodes(end, motion, target, report);
    this->Time = end;
  }
  else
  {
    Move move;
    move.End = end;
    this->MakeStep(motion, target, report, move);
    this->Time = move.Step < end - this->Time ? this->Time + move.Step : end;
  }
  CheckSize(this->CountActive(), this->Maximum);
}

void BandState::StepAndTrace(const Motion& motion, Target& target, AdvanceReport& report)
{
  Move move;
  move.MaySkip = false;
  this->Trace.Begin(this->Leaves);
  this->MakeStep(motion, target, report, move);
  report.SurfaceSpeed = move.IsSkipped ? 0.0 : this->Trace.GetLargest(this->Leaves) / move.Step;
  this->Time += move.IsSkipped ? 0.0 : move.Step;
  CheckSize(this->CountActive(), this->Maximum);
}

void BandState::Confine(const Walls& walls, Obstacle* obstacle)
{
  this->AddGhosts();
  this->Set.ChooseAll(this->Leaves);
  this->Buffers.MakeRoomForNodes(this->Leaves.Size());
  this->Leaves.ForEach(
    [&](std::size_t i) { std::copy_n(this->Leaves[i].Value, 512, this->Buffers.NextOf(i)); });
  ClampToBounds({ walls, obstacle, this->VoxelSize }, this->Leaves, this->Set, this->Buffers);
  CheckObstacle(this->Leaves, obstacle);
  CommitStep(this->Leaves, this->Set, this->Buffers);
  this->RebuildBand(this->Set);
  this->FinishFrame();
  this->StartMeasure = this->Measure();
}

void BandState::RebuildBand(ActiveSet& set)
{
  if (this->Paper)
  {
    RebuildPaperBand(this->Leaves, set, this->Potential->tree());
  }
  else
  {
    RebuildLayers(this->Leaves, set, this->Potential->tree());
    FillGhosts(this->Leaves, set);
  }
  this->DropEmptyLeaves();
}

void BandState::DropEmptyLeaves()
{
  const std::size_t empty =
    this->Leaves.Count([](const LeafSummary& leaf) { return !leaf.IsUsed; });
  if (8 * empty > this->Leaves.Size())
  {
    activesurface::DropEmptyLeaves(this->Leaves, this->Potential->tree());
  }
  this->Crossings = this->Leaves.Count([](const LeafSummary& leaf) { return leaf.Crossings; });
}

void BandState::FinishFrame()
{
  activesurface::DropEmptyLeaves(this->Leaves, this->Potential->tree());
  if (!this->Leaves.IsSorted())
  {
    this->Leaves.Rebuild(this->Potential->tree());
  }
  NumberCrossings(this->Leaves);
  WriteActiveMasks(this->Leaves);
}

}
