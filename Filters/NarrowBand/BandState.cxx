#include "BandState.h"

#include "ExactControl.h"
#include "GhostFill.h"
#include "Layers.h"
#include "NodePoints.h"
#include "PaperStep.h"
#include "RestingLeaves.h"
#include "SamplePoints.h"
#include "StepForward.h"
#include "TargetSpeed.h"
#include "WalledTarget.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace activesurface
{

/** One substep: what is asked for, and what comes of it. */
struct NarrowBand::State::Move
{
  double MostTime = std::numeric_limits<double>::infinity();
  bool MaySleep = true;

  PenaltyForce Force;
  double Step = 0.0; // time
  bool Sleeps = false;
};

namespace
{

/** The potential is doubled or halved when most of its slopes have left 1/sqrt 2 .. sqrt 2. */
float ScaleFor(const SlopeCounts& counts)
{
  return 2 * counts.Flat > counts.Nodes ? 2.f : 2 * counts.Steep > counts.Nodes ? .5f : 1.f;
}

/** Whether this motion ends, and does so by itself: controls never rest. */
bool ComesToRest(const Motion& motion)
{
  return motion.Attraction > 0.0 && motion.AreaControl == Control::None &&
    motion.VolumeControl == Control::None && SamplesCrossings(motion) && !motion.Paper;
}

}

void NarrowBand::State::MakeEmpty()
{
  this->Potential = openvdb::FloatGrid::create(NarrowBand::Far);
  this->Leaves.SetBackground(NarrowBand::Far);
  this->Leaves.Rebuild(this->Potential->tree());
  this->Crossings = 0;
  this->Paper = false;
}

float NarrowBand::State::GetBackground() const
{
  return this->Paper ? PaperThreshold : NarrowBand::Far;
}

StateNumbers NarrowBand::State::GetNumbers() const
{
  return { this->VoxelSize, this->Time, this->StartMeasure.Area, this->StartMeasure.Volume,
    this->BoxSize, this->Paper, this->GetBackground() };
}

void NarrowBand::State::SetNumbers(const StateNumbers& numbers)
{
  this->VoxelSize = numbers.VoxelSize;
  this->Time = numbers.Time;
  this->StartMeasure = { numbers.StartArea, numbers.StartVolume };
  this->BoxSize = numbers.BoxSize;
  this->Paper = numbers.Paper;
}

void NarrowBand::State::TakeTree(const openvdb::FloatTree::Ptr& tree)
{
  this->Potential->setTree(tree);
  this->Leaves.SetBackground(this->GetBackground());
  this->Leaves.Rebuild(*tree);
  ReadActiveMasks(this->Leaves);
  if (this->Paper)
  {
    RebuildPaperBand(this->Leaves, *tree);
  }
  else
  {
    RebuildLayers(this->Leaves, *tree);
  }
  this->Crossings = NumberCrossings(this->Leaves);
}

void NarrowBand::State::Restore(const openvdb::FloatTree::Ptr& tree)
{
  this->TakeTree(tree);
  for (std::size_t i = 0; i < this->Leaves.Size(); ++i)
  {
    this->Leaves[i].Advanced = LeafMask::All();
  }
  if (!this->Paper)
  {
    FillGhosts(this->Leaves);
  }
  this->FinishFrame();
}

void NarrowBand::State::Begin(const Motion& motion)
{
  this->TakeScheme(motion);
  ForgetSpeeds(this->Leaves); // the target may be another one
}

void NarrowBand::State::TakeScheme(const Motion& motion)
{
  if (motion.Paper == this->Paper)
  {
    return;
  }
  this->Paper = motion.Paper;
  this->Leaves.MoveAll();
  this->Leaves.SetBackground(this->GetBackground());
  for (std::size_t i = 0; i < this->Leaves.Size(); ++i)
  {
    // The paper's band begins with all that is known; ghosts begin with none.
    BandLeaf& leaf = this->Leaves[i];
    leaf.Advanced = leaf.Active;
    leaf.Active = this->Paper ? leaf.Upto[LastLayer] : leaf.Active;
    leaf.Unretired = LeafMask::All();
  }
  this->RebuildBand();
}

std::size_t NarrowBand::State::CountActive() const
{
  return this->Leaves.Count([](const LeafSummary& leaf) { return leaf.ActiveNodes; });
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

// Comes before the next potential is taken, so that the last one stays. One check is enough: what
// is measured and written of a bounded potential is finite, a displacement of it too, and the
// paper's scheme clamps.
void NarrowBand::State::RefuseUnbounded(bool isUnbounded) const
{
  if (isUnbounded)
  {
    std::ostringstream text;
    text << "The potential would not be finite after the substep that begins at the motion time "
         << this->Time << ", where the skin stays; lower CFL, to 1 at most, set GradientScheme to "
         << "UPWIND, and Tension to a number >= 0.";
    throw std::runtime_error(text.str());
  }
}

SkinMeasure NarrowBand::State::Measure() const
{
  const SkinMeasure skin = MeasureSkin(this->Leaves);
  const double square = this->VoxelSize * this->VoxelSize;
  return { skin.Area * square, skin.Volume * square * this->VoxelSize };
}

void NarrowBand::State::SampleTarget(const LeafList& leaves, bool isMore, const Motion& motion,
  const Target& target, AdvanceReport& report)
{
  const auto sample = isMore ? SampleMore : SampleLeaves;
  const TargetSamples samples = sample({ this->Leaves, this->Potential->tree(), this->VoxelSize },
    leaves, motion, target, this->Buffers);
  TakeSamples(this->Leaves, leaves, motion, this->Buffers);
  report.TargetEvaluations += samples.Count;
  report.DroppedSamples += samples.Dropped;
}

// The target's speed wherever something moves, and where that is.
TargetLimits NarrowBand::State::FollowTarget(
  const Motion& motion, Target& target, AdvanceReport& report, Move& move)
{
  LeafTable& leaves = this->Leaves;
  if (!(motion.Attraction > 0.0))
  {
    leaves.MoveAll();
    return {};
  }
  const bool mayRest = move.MaySleep && ComesToRest(motion);
  target.MoveTo(this->Time);
  if (mayRest)
  {
    ForgetChanged(leaves, this->VoxelSize, target);
  }
  else
  {
    ForgetSpeeds(leaves);
  }
  const LeafList unknown = FindUnknown(leaves);
  const LeafList sampled = leaves.FindAround(unknown);
  this->SampleTarget(sampled, false, motion, target, report);
  RememberSpeeds(leaves, unknown, this->Buffers);
  const TargetLimits limits = FindLimits(leaves);
  report.MaxSpeed = std::max(report.MaxSpeed, limits.Speed);
  if (mayRest)
  {
    const RestRule rule{ motion, this->VoxelSize, limits.Slope };
    leaves.Move(leaves.FindAround(FindUnrest(leaves, unknown, rule, this->Buffers)));
    if (!std::includes(
          sampled.begin(), sampled.end(), leaves.GetNear().begin(), leaves.GetNear().end()))
    {
      this->SampleTarget(leaves.GetNear(), true, motion, target, report);
    }
  }
  else
  {
    leaves.MoveAll();
  }
  ExtendSpeed(leaves, motion, this->Buffers);
  move.Sleeps = leaves.GetMoving().empty();
  return limits;
}

PenaltyForce NarrowBand::State::FindForce(const Motion& motion) const
{
  const bool isForced =
    motion.AreaControl == Control::Penalty || motion.VolumeControl == Control::Penalty;
  return isForced ? FindPenalty(motion, this->Measure(), this->StartMeasure) : PenaltyForce();
}

void NarrowBand::State::MakeDefaultStep(
  const Motion& motion, const TargetLimits& limits, Move& move)
{
  const double size = this->VoxelSize;
  const double tracking = TrackingRate(motion, size, limits);
  const double step = move.Step;
  StepCoefficients coefficients;
  coefficients.Attracted = motion.Attraction > 0.0;
  coefficients.Central = motion.Gradient == GradientScheme::Central;
  coefficients.Uniform = static_cast<float>(move.Force.Speed);
  coefficients.Advection = AdvectionFactor(step, size);
  coefficients.Tension = static_cast<float>(step * motion.Tension / (size * size));
  const double speed = limits.Speed + std::fabs(move.Force.Speed);
  coefficients.Relaxation = static_cast<float>(RelaxationFor(step * tracking, step * speed / size));
  const SlopeCounts slopes = StepForward(this->Leaves, coefficients, this->Buffers);
  this->RefuseUnbounded(slopes.Unbounded);
  if (motion.Box.Present)
  {
    ClampToWalls(this->Leaves, motion.Box, size, this->Buffers);
  }
  TakeNext(this->Leaves, this->Buffers);
  this->RebuildBand();
  const float scale = ScaleFor(slopes);
  if (scale != 1.f)
  {
    ScalePotential(this->Leaves, scale);
  }
  this->RestoreControlled(motion);
}

void NarrowBand::State::MakePaperStep(const Motion& motion, Move& move)
{
  StepPaper(this->Leaves, AdvectionFactor(move.Step, this->VoxelSize), this->Buffers);
  if (motion.Box.Present)
  {
    ClampToWalls(this->Leaves, motion.Box, this->VoxelSize, this->Buffers);
  }
  TakeNext(this->Leaves, this->Buffers);
  this->RebuildBand();
  this->RestoreControlled(motion);
}

void NarrowBand::State::RestoreControlled(const Motion& motion)
{
  const double square = this->VoxelSize * this->VoxelSize;
  const ControlledBand band{ this->Leaves, this->Buffers, [this] { this->RebuildBand(); },
    motion.Box, this->VoxelSize };
  if (motion.VolumeControl == Control::Exact)
  {
    RestoreVolume(band, HeldVolume(motion, this->StartMeasure) / (square * this->VoxelSize));
  }
  else if (motion.AreaControl == Control::Exact)
  {
    RestoreArea(band, HeldArea(motion, this->StartMeasure) / square);
  }
}

void NarrowBand::State::MakeStep(
  const Motion& motion, Target& target, AdvanceReport& report, Move& move)
{
  WalledTarget walled(target, motion.Box);
  const TargetLimits limits =
    this->FollowTarget(motion, motion.Box.Present ? walled : target, report, move);
  const bool pullsInVain = PullsInVain(motion, this->Buffers);
  move.Force = this->FindForce(motion);
  double stable = StableStep(motion, this->VoxelSize, limits, move.Force);
  move.Sleeps = move.Sleeps || !std::isfinite(stable);
  if (motion.Paper)
  {
    const PaperLimits whole = FindPaperSpeed(this->Leaves, motion.Attraction > 0.0,
      move.Force.Speed, motion.Tension / this->VoxelSize, this->Buffers);
    stable = motion.CFL * PaperTimeStep(whole, motion.Tension, this->VoxelSize, this->BoxSize);
    move.Sleeps = !std::isfinite(stable);
  }
  stable = std::min(stable, motion.LongestStep);
  CheckStep(stable, this->VoxelSize, move.MostTime);
  move.Step = std::min(stable, move.MostTime);
  if (move.Sleeps)
  {
    ++report.Sleeps;
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
  ++report.Substeps;
  report.UniformPulls += pullsInVain ? 1 : 0;
}

void NarrowBand::State::Step(
  double end, const Motion& motion, Target& target, AdvanceReport& report)
{
  Move move;
  move.MostTime = end - this->Time;
  this->MakeStep(motion, target, report, move);
  this->Time = move.Step < move.MostTime ? this->Time + move.Step : end;
  this->CheckSize();
}

void NarrowBand::State::StepAndTrace(const Motion& motion, Target& target, AdvanceReport& report)
{
  Move move;
  move.MaySleep = false;
  this->Trace.Begin(this->Leaves);
  this->MakeStep(motion, target, report, move);
  report.RestSpeed = move.Sleeps ? 0.0 : this->Trace.GetLargest(this->Leaves) / move.Step;
  this->Time += move.Sleeps ? 0.0 : move.Step;
  this->CheckSize();
}

void NarrowBand::State::Confine(const Walls& walls)
{
  this->Leaves.MoveAll();
  this->Buffers.MakeRoomForNodes(this->Leaves.Size());
  this->Leaves.ForEach(
    [&](std::size_t i) { std::copy_n(this->Leaves[i].Value, 512, this->Buffers.NextOf(i)); });
  ClampToWalls(this->Leaves, walls, this->VoxelSize, this->Buffers);
  TakeNext(this->Leaves, this->Buffers);
  this->RebuildBand();
  this->FinishFrame();
  this->StartMeasure = this->Measure();
}

void NarrowBand::State::RebuildBand()
{
  if (this->Paper)
  {
    RebuildPaperBand(this->Leaves, this->Potential->tree());
  }
  else
  {
    RebuildLayers(this->Leaves, this->Potential->tree());
    FillGhosts(this->Leaves);
  }
  const std::size_t empty =
    this->Leaves.Count([](const LeafSummary& leaf) { return !leaf.IsUsed; });
  if (8 * empty > this->Leaves.Size())
  {
    DropEmptyLeaves(this->Leaves, this->Potential->tree());
  }
  this->Crossings = this->Leaves.Count([](const LeafSummary& leaf) { return leaf.Crossings; });
}

void NarrowBand::State::FinishFrame()
{
  DropEmptyLeaves(this->Leaves, this->Potential->tree());
  if (!this->Leaves.IsSorted())
  {
    this->Leaves.Rebuild(this->Potential->tree());
  }
  NumberCrossings(this->Leaves);
  WriteActiveMasks(this->Leaves);
}

}
