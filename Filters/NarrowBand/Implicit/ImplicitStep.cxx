#include "Implicit/ImplicitStep.h"

#include "Implicit/Carry.h"
#include "Implicit/StageWeights.h"
#include "Implicit/StepPlan.h"
#include "Implicit/SurfaceMove.h"
#include "Implicit/TensionStages.h"
#include "Leaves/GhostFill.h"
#include "Leaves/Layers.h"
#include "Leaves/LeafLists.h"
#include "Parts/CreateParts.h"
#include "Substep/ConvergedLeaves.h"
#include "Substep/SamplePoints.h"
#include "Substep/SubstepBuffers.h"
#include "Substep/TargetSpeed.h"
#include "Substep/WalledTarget.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace activesurface
{

namespace
{

constexpr double LongestWayBeforeControl = 0.385; // [voxels], as of an explicit substep

constexpr int MostHalvings = 10; // of a substep, and again of a pass

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
    , Plan(motion, band.Band.VoxelSize, 1.0, force, band.MostTime)
  {
  }

  ImplicitResult Make()
  {
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
    this->Result.Length = this->Plan.GetLength();
    const bool moves = !this->Set.Active.empty() && std::isfinite(this->Result.Length);
    this->Result.IsSkipped = !moves && !this->IsCarried;
    if (moves)
    {
      this->Result.LargestWay = this->Where.MaySkip
        ? 0.0
        : this->FindLargestWay(this->Set.Active, this->FindCoefficients(this->Plan), this->Plan);
      this->Result.Gradients.Nodes =
        this->Leaves.Count([](const LeafSummary& leaf) { return leaf.ZeroNodes; });
      this->Moved = this->Set.Active;
      this->Displace(LeafList(this->Moved), this->Plan, true);
      this->MakeTension();
    }
    return this->Result;
  }

private:
  bool HasTarget() const { return this->Law.Attraction > 0.0; }
  bool IsWeighted() const { return HasTensionWeights(this->Law); }

  /** Carries the surface along first: so the length of the substep has to be right already. */
  void FollowCarried()
  {
    const double length = this->Plan.GetLength();
    this->IsCarried = CarrySurface(this->Where.Band, this->Whole, this->Where.Time,
      this->Where.Time + length, this->Source, this->Report);
    if (!this->HasTarget() && !this->IsWeighted())
    {
      this->ChooseWithoutTarget();
      return;
    }
    const TargetLimits limits = this->SampleTarget();
    this->Plan = this->Plan.ForSlope(SlopeOf(limits));
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
    const double length = this->Plan.GetLength();
    this->Source.MoveTo(
      this->Where.Time + (std::isfinite(length) ? this->Plan.GetSampleTime() * length : 0.0));
    const GrowingBand band{ this->Leaves, this->Set, this->Where.Band.Potential,
      this->Where.Band.VoxelSize, this->Where.MaximumNumberOfActiveVoxels };
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
    constexpr double few = .05;
    const WayCoefficients ways = this->FindCoefficients(plan);
    if (plan.GetStages())
    {
      FindTensionWays(this->Leaves, this->Set.Active, ways, this->IsWeighted(), this->Buffers);
    }
    const bool isControlled =
      this->Law.AreaControl == Control::Exact || this->Law.VolumeControl == Control::Exact;
    LeafList surface;
    std::copy_if(this->Set.Active.begin(), this->Set.Active.end(), std::back_inserter(surface),
      [this](std::int32_t i) { return this->Leaves[i].Crossings > 0; });
    int halvings = 0;
    for (; halvings < MostHalvings; ++halvings)
    {
      const auto count = [&](double longest, auto&& wayOf)
      {
        return static_cast<double>(std::count_if(surface.begin(), surface.end(),
          [&](std::int32_t i) { return wayOf(i) > std::ldexp(longest, halvings); }));
      };
      const bool isTense = plan.GetStages() &&
        count(LongestWayByTension,
          [this](std::int32_t i)
          { return this->Buffers.LargestTensionWay[i]; }) > few * surface.size();
      const bool isFar = isControlled &&
        count(LongestWayBeforeControl,
          [&](std::int32_t i) { return WayOf(i, ways, this->Buffers); }) > 0.0;
      if (!isTense && !isFar)
      {
        break;
      }
    }
    return halvings;
  }

  bool TargetChangesBy(const StepPlan& plan) const
  {
    this->Source.MoveTo(this->Where.Time + plan.GetSampleTime() * plan.GetLength());
    ForgetChanged(this->Leaves, this->Where.Band.VoxelSize, this->Source);
    constexpr double everywhere[6] = { -HUGE_VAL, HUGE_VAL, -HUGE_VAL, HUGE_VAL, -HUGE_VAL,
      HUGE_VAL };
    return this->Source.MayHaveChanged(everywhere);
  }

  /** Of all terms but the controls. */
  float FindLargestWay(
    const LeafList& leaves, const WayCoefficients& coefficients, const StepPlan& plan) const
  {
    return plan.GetStages()
      ? LargestNetWay(this->Leaves, leaves, coefficients, this->IsWeighted(), this->Buffers)
      : LargestWay(leaves, coefficients, this->Buffers);
  }

  WayCoefficients FindCoefficients(const StepPlan& plan) const
  {
    WayCoefficients coefficients;
    coefficients.HasTargetSpeed = this->HasTarget();
    coefficients.Factor = this->HasTarget() ? static_cast<float>(plan.GetFactor()) : 0.f;
    coefficients.Uniform = static_cast<float>(plan.GetUniformWay());
    coefficients.Longest = LongestWay;
    coefficients.SourcePerWay = static_cast<float>(plan.GetSourcePerWay());
    coefficients.Tension = static_cast<float>(plan.GetTension() / plan.GetSourcePerWay());
    return coefficients;
  }

  /** leaves: whose target speeds are known. plan: of the substep, or a part of its way. */
  void Displace(const LeafList& leaves, const StepPlan& plan, bool isFirst)
  {
    const WayCoefficients coefficients = this->FindCoefficients(plan);
    this->TakeSlopesIntoAccount(plan);
    LeafList fast;
    const bool maySplit = plan.GetLength() > std::ldexp(this->Plan.GetLength(), -MostHalvings);
    std::copy_if(leaves.begin(), leaves.end(), std::back_inserter(fast),
      [&](std::int32_t i)
      { return maySplit && WayOf(i, coefficients, this->Buffers) > coefficients.Longest; });
    LeafList region = this->Leaves.FindAround(fast);
    region = isFirst ? region : Intersection(region, leaves);
    this->MakePass(Without(leaves, region), coefficients, plan);
    for (int half = 0; half < 2 && !region.empty() && !this->Result.Gradients.Unbounded; ++half)
    {
      const std::size_t before = this->Leaves.Size();
      this->SampleAgain(region);
      this->Displace(region, plan.HalveWay(), false);
      region = Union(region, this->Leaves.FindAll([before](std::size_t i) { return i >= before; }));
    }
    this->Moved = Union(this->Moved, region);
  }

  void SampleAgain(const LeafList& leaves)
  {
    if (this->HasTarget() || this->IsWeighted())
    {
      const FollowingBand& band = this->Where.Band;
      const LeafList sampled = this->Leaves.FindAround(leaves);
      const TargetSamples samples = SampleLeaves({ band.Leaves, band.Potential, band.VoxelSize },
        sampled, this->Law, this->Source, this->Buffers);
      ApplySamples(this->Leaves, sampled, this->Law, this->Buffers);
      this->Report.TargetEvaluations += samples.Count;
      this->Report.DroppedSamples += samples.Dropped;
    }
  }

  /** Samples of another slope go farther, or less far, than those of the largest. */
  void TakeSlopesIntoAccount(const StepPlan& plan)
  {
    if (!this->HasTarget())
    {
      return;
    }
    bool differs = false;
    for (std::size_t n = 0; n < this->Buffers.Samples.size(); ++n)
    {
      const double ratio = plan.GetRatio(this->Buffers.SlopeSamples[n]);
      this->Buffers.Samples[n] *= static_cast<float>(ratio);
      differs = differs || ratio != 1.0;
    }
    if (differs)
    {
      const auto& first = this->Buffers.FirstSample;
      const LeafList sampled = this->Leaves.FindAll([&first](std::size_t i)
        { return i < first.size() && first[i] != SubstepBuffers::NoSamples; });
      ApplySamples(this->Leaves, sampled, this->Law, this->Buffers);
    }
  }

  /** Displaces these leaves, or leaves that to the stages of the plan. */
  void MakePass(const LeafList& leaves, WayCoefficients coefficients, const StepPlan& plan)
  {
    if (leaves.empty())
    {
      return;
    }
    coefficients.Relaxation =
      static_cast<float>(plan.GetRelaxation(this->FindStrain(leaves, coefficients, plan)));
    this->Set.Choose(this->Leaves, leaves);
    FindWays(this->Leaves, this->Set, coefficients, this->Buffers);
    ExtendSpeed(this->Leaves, this->Set, this->Law, this->Buffers);
    if (this->IsWeighted())
    {
      this->Weights.Remember(this->Set, this->Buffers);
    }
    if (plan.GetStages())
    {
      this->Sourced = leaves;
      this->Count(FindSources(this->Leaves, this->Set, coefficients, this->Buffers));
      return;
    }
    this->Count(MoveSurface(this->Leaves, this->Set, coefficients, this->Buffers));
    if (!this->Result.Gradients.Unbounded)
    {
      this->Commit();
    }
  }

  /** The longest way. One that tension goes back strains nothing; but attraction's does, as it
   * differs from place to place. */
  float FindStrain(
    const LeafList& leaves, const WayCoefficients& coefficients, const StepPlan& plan) const
  {
    const float way = LargestWay(leaves, coefficients, this->Buffers);
    return this->HasTarget() || way == 0.f
      ? way
      : std::min(way, this->FindLargestWay(leaves, coefficients, plan));
  }

  void Count(const GradientCounts& counts)
  {
    this->Result.Gradients.Flat += counts.Flat;
    this->Result.Gradients.Steep += counts.Steep;
    this->Result.Gradients.Unbounded = counts.Unbounded;
  }

  void MakeTension()
  {
    if (!this->Plan.GetStages() || this->Result.Gradients.Unbounded)
    {
      return;
    }
    this->Set.Choose(this->Leaves, this->Moved);
    if (this->IsWeighted())
    {
      this->Weights.ExtendToEntered(this->Leaves, this->Set, this->Law, this->Buffers);
    }
    this->Buffers.StageSource.MakeRoom(this->Leaves.Size());
    this->Leaves.ForEach(Without(this->Moved, this->Sourced),
      [this](std::size_t i) { std::fill_n(this->Buffers.StageSource.Of(i), 512, 0.f); });
    const bool isBounded =
      MakeTensionStages(this->Leaves, this->Set, this->Plan, this->IsWeighted(), this->Buffers);
    this->Result.Gradients.Unbounded = !isBounded;
    if (isBounded)
    {
      this->Commit();
    }
  }

  /** Takes the next potential; layers and ghosts follow. */
  void Commit()
  {
    ClampToBounds({ this->Law.Box, this->Law.Solid, this->Where.Band.VoxelSize }, this->Leaves,
      this->Set, this->Buffers);
    CommitStep(this->Leaves, this->Set, this->Buffers);
    RebuildLayers(this->Leaves, this->Set, this->Where.Band.Potential);
    if (this->HasTarget())
    {
      FillGhostsAndEntered(this->Leaves, this->Set, this->Buffers.Nodes);
    }
    else
    {
      FillGhosts(this->Leaves, this->Set); // more exact for tension alone
    }
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
  StepPlan Plan;
  ImplicitResult Result;
  bool IsCarried = false;
  LeafList Moved;   //< by this substep, or created by that
  LeafList Sourced; //< those of them whose displacement is left to the stages
  StageWeights Weights;
};

}

ImplicitResult MakeImplicitStep(const ImplicitBand& band, const Motion& motion,
  const PenaltyForce& force, Target& target, AdvanceReport& report)
{
  return Substep(band, motion, force, target, report).Make();
}

}
