#include "Implicit/ImplicitStep.h"

#include "Implicit/Carry.h"
#include "Implicit/LeafBalances.h"
#include "Implicit/StepPlan.h"
#include "Implicit/SurfaceMove.h"
#include "Implicit/SurfacePasses.h"
#include "Leaves/GhostFill.h"
#include "Leaves/Layers.h"
#include "Parts/CreateParts.h"
#include "Substep/ConvergedLeaves.h"
#include "Substep/SubstepBuffers.h"
#include "Substep/TargetSpeed.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace activesurface
{

namespace
{

constexpr double LongestDisplacementBeforeControl = 0.385; // [voxels], as of an explicit substep

Motion WithoutTransport(Motion motion)
{
  motion.Transport = 0.0;
  return motion;
}

double SlopeOf(const TargetLimits& limits)
{
  return limits.TargetSlope > 0.0 ? limits.TargetSlope : 1.0;
}

class Substep
{
public:
  Substep(const ImplicitBand& band, const Motion& motion, const PenaltyForce& force, Target& target,
    AdvanceReport& report)
    : Where(band)
    , Leaves(band.Band.Leaves)
    , Buffers(band.Band.Buffers)
    , Set(band.Band.Set)
    , Law(WithoutTransport(motion))
    , Whole(motion)
    , Force(force)
    , Source(target)
    , Report(report)
    , Passes(band.Band, this->Law, target, report)
    , Plan(motion, band.Band.VoxelSize, 1.0, force, band.MostTime)
  {
  }

  ImplicitResult Make()
  {
    this->CheckLength(this->Plan, std::numeric_limits<double>::infinity());
    if (HasTargetSpeed(this->Whole) || this->IsWeighted())
    {
      this->Whole.Transport > 0.0 ? this->FollowCarried() : this->Follow();
      this->Result.PullsInVain = activesurface::PullsInVain(this->Law, this->Buffers);
    }
    else
    {
      this->Set.ChooseAll(this->Leaves);
      this->Plan = this->PlanFor({});
    }
    this->CheckLength(this->Plan, this->Where.MostTime);
    this->Result.Length = this->Rounds * this->Plan.GetLength();
    this->Result.Rounds = this->Rounds;
    const bool moves = !this->Set.Active.empty() && std::isfinite(this->Result.Length);
    this->Result.IsSkipped = !moves && !this->IsCarried;
    if (moves)
    {
      this->Result.LargestDisplacement = this->Where.MaySkip
        ? 0.0
        : this->Passes.FindLargestDisplacement(this->Set.Active, this->Plan);
      this->MakeRounds();
    }
    return this->Result;
  }

private:
  bool HasTarget() const { return this->Law.Attraction > 0.0; }
  bool IsWeighted() const { return HasTensionWeights(this->Law); }

  void CheckLength(const StepPlan& plan, double mostTime) const
  {
    CheckStep(plan.GetLength(), this->Where.Band.VoxelSize, mostTime);
  }

  /** Where the target moves the surface as it moves itself, nothing but its own change is left to
   * follow after the whole displacement: then there is one for all rounds. */
  bool MayCarryFar() const
  {
    const bool isControlled =
      this->Law.AreaControl != Control::None || this->Law.VolumeControl != Control::None;
    return this->Whole.Transport == 1.0 && std::isfinite(this->Where.MostTime) && !isControlled;
  }

  /** Carries the surface along first: so the length of the substep has to be right already. */
  void FollowCarried()
  {
    const double length = this->MayCarryFar() ? this->Where.MostTime : this->Plan.GetLength();
    this->CheckLength(this->Plan, length);
    this->Rounds = static_cast<int>(std::lround(length / this->Plan.GetLength()));
    this->IsCarried = CarrySurface(this->Where.Band, this->Whole, this->Where.Time,
      this->Where.Time + length, this->Source, this->Report);
    if (!this->HasTarget() && !this->IsWeighted())
    {
      this->ChooseWithoutTarget();
      return;
    }
    const double slope = SlopeOf(this->SampleTarget());
    if (this->Rounds > 1)
    {
      this->Plan = StepPlan(this->Whole, this->Where.Band.VoxelSize, slope, this->Force, length);
      this->CheckLength(this->Plan, length);
      this->Rounds = static_cast<int>(std::lround(length / this->Plan.GetLength()));
    }
    else
    {
      this->Plan = this->Plan.ForSlope(slope);
    }
  }

  /** As soon as the surface is calm, one for all that are left. */
  void MakeRounds()
  {
    this->Result.Rounds = 0;
    for (int left = this->Rounds; left > 0 && !this->Result.Gradients.Unbounded; --left)
    {
      if (left < this->Rounds)
      {
        this->FindSpeedsAgain();
      }
      ++this->Result.Rounds;
      const bool isJoined = left > 1 && this->Passes.IsCalm(this->Plan, left);
      if (!this->Set.Active.empty())
      {
        const std::size_t nodes =
          this->Leaves.Count([](const LeafSummary& leaf) { return leaf.ZeroNodes; });
        this->Result.Gradients =
          isJoined ? this->Passes.RunJoined(this->Plan, left) : this->Passes.Run(this->Plan);
        this->Result.Gradients.Nodes = nodes;
      }
      if (isJoined)
      {
        return;
      }
    }
  }

  void FindSpeedsAgain()
  {
    if (this->HasTarget() || this->IsWeighted())
    {
      this->SampleTarget();
    }
    else
    {
      this->ChooseWithoutTarget();
    }
  }

  /** What Transport has carried, unless something else moves all. */
  void ChooseWithoutTarget()
  {
    if (this->Plan.GetStages() || this->Force.Speed != 0.0)
    {
      this->Set.ChooseAll(this->Leaves);
    }
    else if (!this->IsCarried)
    {
      this->Set.Choose(this->Leaves, {});
    }
  }

  /** Samples the target at the time that the plan says, and plans again for what it finds there. */
  void Follow()
  {
    TargetLimits limits = this->SampleTarget();
    const StepPlan better = this->PlanFor(limits);
    if (better.GetLength() != this->Plan.GetLength() && this->TargetChangesBy(better))
    {
      this->Plan = better;
      limits = this->SampleTarget();
    }
    this->Plan = better;
  }

  TargetLimits SampleTarget()
  {
    const double length = this->Rounds * this->Plan.GetLength();
    this->Source.MoveTo(
      this->Where.Time + (std::isfinite(length) ? this->Plan.GetSampleTime() * length : 0.0));
    const GrowingBand band{ this->Leaves, this->Set, this->Where.Band.Potential,
      this->Where.Band.VoxelSize, this->Where.MaximumNumberOfActiveVoxels, this->Where.Backup };
    if (this->Law.CreateParts && this->Source.HasRegions() &&
      CreateParts(band, this->Law, this->Source, this->Report))
    {
      RebuildLayers(this->Leaves, this->Set, this->Where.Band.Potential);
      FillGhosts(this->Leaves, this->Set);
    }
    return FollowTarget(
      this->Where.Band, this->Law, this->Where.MaySkip, this->Source, this->Report);
  }

  StepPlan PlanFor(const TargetLimits& limits) const
  {
    const StepPlan plan(
      this->Whole, this->Where.Band.VoxelSize, SlopeOf(limits), this->Force, this->Where.MostTime);
    return this->Set.Active.empty() ? plan : plan.Halve(this->FindHalvings(plan));
  }

  /** So that tension goes no farther than a substep bears in nearly all leaves; and the target too,
   * in all, where a control follows each substep. */
  int FindHalvings(const StepPlan& plan) const
  {
    const MoveCoefficients coefficients = CoefficientsOf(this->Law, plan);
    if (plan.GetStages())
    {
      FindBalances(this->Leaves, this->Set.Active, coefficients, this->IsWeighted(), this->Buffers);
    }
    const bool isControlled =
      this->Law.AreaControl == Control::Exact || this->Law.VolumeControl == Control::Exact;
    const LeafList surface = this->FindSurface();
    int halvings = 0;
    for (; halvings < MostHalvings; ++halvings)
    {
      const auto count = [&](double longest, auto&& displacementOf)
      {
        return static_cast<double>(std::count_if(surface.begin(), surface.end(),
          [&](std::int32_t i) { return displacementOf(i) > std::ldexp(longest, halvings); }));
      };
      const bool isTense = plan.GetStages() &&
        count(LongestDisplacementByTension,
          [this](std::int32_t i) { return this->Buffers.Balances[i].Tension; }) >
          FewLeaves * static_cast<double>(surface.size());
      const bool isFar = isControlled &&
        count(LongestDisplacementBeforeControl,
          [&](std::int32_t i) { return DisplacementOf(i, coefficients, this->Buffers); }) > 0.0;
      if (!isTense && !isFar)
      {
        break;
      }
    }
    return halvings;
  }

  LeafList FindSurface() const
  {
    LeafList surface;
    std::copy_if(this->Set.Active.begin(), this->Set.Active.end(), std::back_inserter(surface),
      [this](std::int32_t i) { return this->Leaves[i].Crossings > 0; });
    return surface;
  }

  bool TargetChangesBy(const StepPlan& plan) const
  {
    this->Source.MoveTo(this->Where.Time + plan.GetSampleTime() * plan.GetLength());
    ForgetChanged(this->Leaves, this->Where.Band.VoxelSize, this->Source);
    constexpr double everywhere[6] = { -HUGE_VAL, HUGE_VAL, -HUGE_VAL, HUGE_VAL, -HUGE_VAL,
      HUGE_VAL };
    return this->Source.MayHaveChanged(everywhere);
  }

  const ImplicitBand& Where;
  LeafTable& Leaves;
  SubstepBuffers& Buffers;
  ActiveSet& Set;
  const Motion Law; //< of what remains after Transport
  const Motion& Whole;
  const PenaltyForce& Force;
  Target& Source;
  AdvanceReport& Report;
  SurfacePasses Passes;
  StepPlan Plan;
  ImplicitResult Result;
  int Rounds = 1; //< of displacement and tension, after one carry
  bool IsCarried = false;
};

}

ImplicitResult MakeImplicitStep(const ImplicitBand& band, const Motion& motion,
  const PenaltyForce& force, Target& target, AdvanceReport& report)
{
  return Substep(band, motion, force, target, report).Make();
}

}
