#include "Nodes/NodeStep.h"

#include "Nodes/PeriodicLattice.h"

#include "Base/Obstacle.h"
#include "Base/OpenVDB.h"
#include "Front/TimeStep.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace activesurface
{

namespace
{

/** A leaf without noticeable displacement (LeafMotion::IsStill) stays bitwise identical if u
 * changes by at most RestingChange * StageCoefficients::Decay [voxels] in layers 0 and 1, and
 * within a voxel of the new skin. */
constexpr float RestingChange = 3e-4f;

/** Attraction * duration for which tension acts on a skin with NodeFreedom. */
constexpr double FactorsOfFreeSkin = 6.0;

/** Calls function(i, origin) for the leaves with nodes beyond the sides of a periodic box, in
 * parallel if isThreadSafe. */
template <class Function>
void ForEachBeyond(
  const NodeLeaves& leaves, const PeriodicLattice& lattice, bool isThreadSafe, Function&& function)
{
  const auto visit = [&](std::size_t i)
  {
    if (!lattice.IsWithin(leaves[i].Origin))
    {
      function(i, leaves[i].Origin);
    }
  };
  if (isThreadSafe)
  {
    leaves.ForEach(visit);
    return;
  }
  for (std::size_t i = 0; i < leaves.Size(); ++i)
  {
    visit(i);
  }
}

}

openvdb::FloatTree::Ptr NodeStep::Make(
  const NodeFrame& frame, const Motion& motion, NodeTarget& target)
{
  target.PlaceNodes({ frame.Begin, frame.End, motion.Transport, frame.VoxelSize, frame.Space });
  this->FindLeaves(frame, motion, target);
  this->Evaluate(target);
  this->Halo.Refresh(this->Room);
  this->Freedom = target.GetFreedom();
  FindDistances(this->Leaves, this->Room, this->Freedom, this->Psi, this->Slack);
  this->Confine(this->Psi, this->Freedom.Unit, frame, motion);
  this->FetchOld(frame, target);
  this->Carry(frame, target);
  const StageCoefficients coefficients = this->FindCoefficients(frame, motion, target);
  RunStages({ this->Leaves, this->Psi, this->Bulk, this->IsFar, this->Potential, this->Room,
              this->Halo, this->IsFree() ? &this->Slack : nullptr, this->Freedom.Unit },
    coefficients);
  this->ConvertToVoxels();
  this->RestOnWalls(frame, motion, target.GetWallGap());
  this->Confine(this->Potential, 1.f, frame, motion);
  this->KeepWhatRests(frame.Old, RestingChange * coefficients.Decay);
  this->Repeat(frame, motion, target);
  this->Halo.Refresh(this->Potential);
  return this->MakeTree(frame, motion);
}

StageCoefficients NodeStep::FindCoefficients(
  const NodeFrame& frame, const Motion& motion, const NodeTarget& target) const
{
  // A free skin begins each frame at the target, so its tension does not depend on the duration.
  const double duration = this->IsFree() ? FactorsOfFreeSkin / motion.Attraction : frame.Duration;
  StageCoefficients coefficients;
  coefficients.Decay = this->IsFree() ? 0.f : static_cast<float>(motion.Attraction * duration);
  coefficients.Tension =
    static_cast<float>(motion.Tension * duration / (frame.VoxelSize * frame.VoxelSize));
  coefficients.Noise = target.GetNoise();
  coefficients.IsWeighted = motion.WeightedTension;
  return coefficients;
}

std::size_t NodeStep::CountEvaluations() const
{
  std::size_t rows = 0;
  for (const ShellLeaf& leaf : this->Near.Leaves)
  {
    rows += static_cast<std::size_t>(CountBits(leaf.Rows));
  }
  return 8 * rows;
}

void NodeStep::FindLeaves(const NodeFrame& frame, const Motion& motion, const NodeTarget& target)
{
  const bool isConfined = motion.Box.Present || motion.Solid;
  target.FindShell(isConfined || frame.Space, this->Near);
  // On average, a leaf that the surface crosses has more than an eighth of its nodes active.
  constexpr std::size_t fewestNodes = 64, margin = 4;
  CheckSize(fewestNodes / margin * this->Near.Leaves.size(), frame.MaximumNumberOfActiveVoxels);
  if (isConfined)
  {
    this->AddConfined(frame, motion);
  }
  const std::size_t own = this->Halo.Find(frame.Space, this->Near.Leaves);
  if (motion.Solid)
  {
    this->SampleSolid(own, *motion.Solid);
  }
  this->Leaves.Adopt(this->Near.Leaves, own, !motion.Solid || motion.Solid->IsThreadSafe(),
    [&](const NodeIndex& origin)
    { return target.IsInside(CentreOf(origin)) && !this->IsSolid(origin, frame, motion); });
  const std::size_t count = this->Leaves.Size();
  this->Potential.MakeRoom(count);
  this->Room.MakeRoom(count);
  this->Psi.MakeRoom(count);
  this->Bulk.resize(count);
  this->IsFar.resize(count);
  this->IsStill.assign(count, 0);
}

/** Writes the target's potential G (NodeStages.h) to Room; rows outside the shell get + or - 1. */
void NodeStep::Evaluate(const NodeTarget& target)
{
  this->Leaves.ForEach(
    [&](std::size_t i)
    {
      const NodeLeaf& leaf = this->Leaves[i];
      float* values = this->Room.Of(i);
      target.EvaluateLeaf(leaf, values);
      for (int row = 0; row < 64; ++row)
      {
        if (!((leaf.Rows >> row) & 1))
        {
          std::fill_n(values + 8 * row, 8, (leaf.InsideRows >> row) & 1 ? -1.f : 1.f);
        }
      }
    });
}

void NodeStep::Carry(const NodeFrame& frame, const NodeTarget& target)
{
  const bool isStart = !(frame.End > frame.Begin) || this->IsFree();
  this->Leaves.ForEach(
    [&](std::size_t i)
    {
      const NodeLeaf& leaf = this->Leaves[i];
      LeafMotion motion;
      if (this->Motions.empty())
      {
        target.FindMotion(leaf, motion);
      }
      else
      {
        motion = this->Motions[i];
      }
      std::copy_n(motion.Bulk, LeafMotion::Points, this->Bulk[i].begin());
      this->IsStill[i] = motion.IsStill ? 1 : 0;
      if (isStart)
      {
        std::copy_n(this->Psi.Of(i), 512, this->Potential.Of(i));
      }
      else
      {
        CarryNodes(frame.Old, leaf, motion, this->Psi.Of(i), this->Potential.Of(i));
      }
      this->IsFar[i] = this->StaysFar(i) ? 1 : 0;
      if (this->IsFar[i])
      {
        std::copy_n(this->Psi.Of(i), 512, this->Room.Of(i));
      }
    });
}

/** Converts the potential from the freedom's Unit to voxels. */
void NodeStep::ConvertToVoxels()
{
  const float unit = this->Freedom.Unit;
  if (unit > 1.f)
  {
    this->Leaves.ForEach(
      [&](std::size_t i)
      {
        float* values = this->Potential.Of(i);
        std::transform(values, values + 512, values,
          [unit](float value) { return std::clamp(unit * value, -NodeLimit, NodeLimit); });
      });
  }
}

bool NodeStep::StaysFar(std::size_t i) const
{
  const float *psi = this->Psi.Of(i), *carried = this->Potential.Of(i);
  return std::fabs(psi[0]) == NodeLimit &&
    std::all_of(psi, psi + 512, [psi](float value) { return value == psi[0]; }) &&
    std::all_of(carried, carried + 512, [psi](float value) { return value == psi[0]; });
}

void NodeStep::KeepWhatRests(const OldPotential& old, float tolerance)
{
  this->Leaves.ForEach(
    [&](std::size_t i)
    {
      const OldLeaf before = this->IsStill[i] ? old.FindLeaf(this->Leaves[i].Origin) : OldLeaf();
      if (!before.Value)
      {
        return;
      }
      float* now = this->Potential.Of(i);
      bool rests = true;
      for (int node = 0; rests && node < 512; ++node)
      {
        if (before.FirstLayers->Has(node) || std::fabs(now[node]) < 1.f)
        {
          const float kept = std::clamp(before.Value[node], -NodeLimit, NodeLimit);
          rests = std::fabs(kept - now[node]) <= tolerance;
        }
      }
      if (rests)
      {
        std::copy_n(before.Value, 512, now);
      }
    });
}

/** Sets the potential beyond the sides of a periodic box to the values at the repeated positions,
 * interpolated between nodes. */
void NodeStep::Repeat(const NodeFrame& frame, const Motion& motion, const NodeTarget& target)
{
  if (!motion.Period.Any())
  {
    return;
  }
  const PeriodicLattice lattice(motion.Period, frame.VoxelSize);
  const auto valueAt = [&](const NodeIndex& node)
  {
    const NodeIndex origin = { node[0] & ~7, node[1] & ~7, node[2] & ~7 };
    const std::int32_t leaf = this->Leaves.Find(origin);
    return leaf >= 0 ? this->Potential.Of(static_cast<std::size_t>(
                         leaf))[64 * (node[0] & 7) + 8 * (node[1] & 7) + (node[2] & 7)]
      : target.IsInside(CentreOf(origin)) && !this->IsSolid(origin, frame, motion) ? -NodeLimit
                                                                                   : NodeLimit;
  };
  const bool isThreadSafe = !motion.Solid || motion.Solid->IsThreadSafe();
  ForEachBeyond(this->Leaves, lattice, isThreadSafe,
    [&](std::size_t i, const NodeIndex& origin)
    {
      for (int n = 0; n < 512; ++n)
      {
        this->Room.Of(i)[n] = lattice.Interpolate(
          { origin[0] + (n >> 6), origin[1] + (n >> 3 & 7), origin[2] + (n & 7) }, valueAt);
      }
    });
  ForEachBeyond(this->Leaves, lattice, true,
    [&](std::size_t i, const NodeIndex&)
    { std::copy_n(this->Room.Of(i), 512, this->Potential.Of(i)); });
  this->Confine(this->Potential, 1.f, frame, motion);
}

}
