#include "Implicit/SurfacePasses.h"

#include "Implicit/LeafBalances.h"
#include "Implicit/TensionStages.h"
#include "Leaves/GhostFill.h"
#include "Leaves/Layers.h"
#include "Leaves/LeafExchange.h"
#include "Leaves/LeafLists.h"
#include "Substep/SamplePoints.h"
#include "Substep/SubstepBuffers.h"
#include "Substep/TargetSpeed.h"
#include "Substep/WalledTarget.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <vector>

namespace activesurface
{

namespace
{

// [voxels] at CFL 1: the target is linear along it, and so is its balance with tension.
constexpr double ShortDisplacement = .25, ShortDisplacementOfStages = .08;

}

MoveCoefficients CoefficientsOf(const Motion& law, const StepPlan& plan)
{
  const bool hasTarget = law.Attraction > 0.0;
  MoveCoefficients coefficients;
  coefficients.HasTargetSpeed = hasTarget;
  // Details of a target that the lattice cannot hold make a surface rougher for ever by central
  // gradients, where tension is too weak to smooth them: its length is below a quarter of a voxel.
  coefficients.IsUpwind = hasTarget && 16.0 * plan.GetTension() < plan.GetDamping();
  coefficients.Factor = hasTarget ? static_cast<float>(plan.GetFactor()) : 0.f;
  coefficients.Uniform = static_cast<float>(plan.GetUniformDisplacement());
  coefficients.SourcePerDisplacement = static_cast<float>(plan.GetSourcePerDisplacement());
  coefficients.Tension = static_cast<float>(plan.GetTension() / plan.GetSourcePerDisplacement());
  return coefficients;
}

SurfacePasses::SurfacePasses(
  const FollowingBand& band, const Motion& law, Target& target, AdvanceReport& report)
  : Band(band)
  , Leaves(band.Leaves)
  , Buffers(band.Buffers)
  , Set(band.Set)
  , Law(law)
  , Source(target)
  , Report(report)
{
}

float SurfacePasses::FindLargestDisplacement(const LeafList& leaves, const StepPlan& plan) const
{
  const MoveCoefficients coefficients = CoefficientsOf(this->Law, plan);
  if (!plan.GetStages())
  {
    return LargestDisplacement(leaves, coefficients, this->Buffers);
  }
  FindBalances(this->Leaves, leaves, coefficients, this->IsWeighted(), this->Buffers);
  float largest = 0.f;
  for (const std::int32_t i : leaves)
  {
    largest = std::max(largest, this->Buffers.Balances[i].Net);
  }
  return largest;
}

GradientCounts SurfacePasses::Run(const StepPlan& plan)
{
  this->Gradients = {};
  this->MakeSubstep({ { this->Set.Active, plan } });
  return this->Gradients;
}

GradientCounts SurfacePasses::RunJoined(const StepPlan& plan, int substeps)
{
  std::vector<LeafShare> shares = { { {}, plan.JoinGently(substeps) },
    { {}, plan.Join(substeps) } };
  const LeafList& active = this->Set.Active;
  std::partition_copy(active.begin(), active.end(), std::back_inserter(shares[0].Leaves),
    std::back_inserter(shares[1].Leaves),
    [&](std::int32_t i)
    { return shares[0].Plan.Bears(this->Leaves.SummaryOf(i).Speed.TargetSlope); });
  this->Gradients = {};
  this->MakeSubstep(shares);
  return this->Gradients;
}

bool SurfacePasses::IsCalm(const StepPlan& plan, int substeps) const
{
  const LeafList& active = this->Set.Active;
  const StepPlan joined = plan.Join(substeps);
  if (plan.GetStages())
  {
    FindBalances(this->Leaves, active, CoefficientsOf(this->Law, plan.JoinGently(substeps)),
      this->IsWeighted(), this->Buffers);
  }
  const auto surface = std::count_if(
    active.begin(), active.end(), [this](std::int32_t i) { return this->Leaves[i].Crossings > 0; });
  const auto restless = SumOverRanks<1>(this->Leaves,
    { std::count_if(active.begin(), active.end(),
      [&](std::int32_t i) {
        return this->Leaves.IsOwn(i) && this->Leaves[i].Crossings > 0 && !this->IsCalm(i, joined);
      }) })[0];
  const double few = plan.GetStages() ? 0.0 : FewLeaves;
  return static_cast<double>(restless) <= few * static_cast<double>(surface);
}

/** Whether the target is linear along the displacement, and tension balanced by it. */
bool SurfacePasses::IsCalm(std::int32_t leaf, const StepPlan& plan) const
{
  const double most =
    this->Law.CFL * (plan.GetStages() ? ShortDisplacementOfStages : ShortDisplacement);
  if (plan.GetStages() && this->Buffers.Balances[leaf].Tension > most)
  {
    return false;
  }
  const std::int64_t first = this->HasTarget() ? this->Buffers.FirstSample[leaf] : 0;
  const std::int64_t end = first + (this->HasTarget() ? this->Leaves[leaf].Crossings : 0);
  const double factor = this->Law.Attraction * plan.GetFactor();
  for (std::int64_t n = first; n < end; ++n)
  {
    const double ratio = plan.GetRatio(this->Buffers.SlopeSamples[n]);
    if (std::fabs(factor * ratio * this->Buffers.Samples[n]) > most)
    {
      return false;
    }
  }
  return true;
}

/** The last of the shares may go far. */
void SurfacePasses::MakeSubstep(const std::vector<LeafShare>& shares)
{
  const StepPlan& plan = shares.back().Plan;
  LeafList leaves;
  for (const LeafShare& share : shares)
  {
    leaves = Union(leaves, share.Leaves);
  }
  this->Moved = leaves;
  this->Sourced.clear();
  this->TakeSlopesIntoAccount(shares);
  this->Displace(leaves, plan, 0);
  if (!plan.GetStages())
  {
    return;
  }
  LeafList others = this->Moved;
  for (std::size_t n = 0; n + 1 < shares.size(); ++n)
  {
    const LeafShare& share = shares[n];
    const auto scale =
      static_cast<float>(share.Plan.GetSourcePerDisplacement() / plan.GetSourcePerDisplacement());
    this->Leaves.ForEach(Intersection(share.Leaves, this->Sourced),
      [&](std::size_t i)
      {
        float* source = this->Buffers.StageSource.Of(i);
        std::transform(
          source, source + 512, source, [scale](float change) { return scale * change; });
      });
    this->MakeTension(share.Leaves, share.Plan);
    others = Without(others, share.Leaves);
  }
  this->MakeTension(others, plan);
}

/** plan: of the substep, or of its displacement halved so often. */
void SurfacePasses::Displace(const LeafList& leaves, const StepPlan& plan, int halvings)
{
  const MoveCoefficients coefficients = CoefficientsOf(this->Law, plan);
  LeafList fast;
  std::copy_if(leaves.begin(), leaves.end(), std::back_inserter(fast),
    [&](std::int32_t i)
    {
      return halvings < MostHalvings &&
        DisplacementOf(i, coefficients, this->Buffers) > LongestDisplacement;
    });
  LeafList region = this->Leaves.FindAround(fast);
  region = halvings == 0 ? region : Intersection(region, leaves);
  this->MakePass(Without(leaves, region), plan);
  for (int half = 0; half < 2 && !region.empty() && !this->Gradients.Unbounded; ++half)
  {
    const std::size_t before = this->Leaves.Size();
    const StepPlan halved = plan.HalveDisplacement();
    this->SampleAgain(region);
    this->TakeSlopesIntoAccount({ { {}, halved } });
    this->Displace(region, halved, halvings + 1);
    region = Union(region, this->Leaves.FindAll([before](std::size_t i) { return i >= before; }));
  }
  this->Moved = Union(this->Moved, region);
}

void SurfacePasses::SampleAgain(const LeafList& leaves)
{
  if (this->HasTarget() || this->IsWeighted())
  {
    const FollowingBand& band = this->Band;
    const LeafList sampled = this->Leaves.FindAround(leaves);
    const TargetSamples samples = SampleLeaves({ band.Leaves, band.Potential, band.VoxelSize },
      sampled, this->Law, this->Source, this->Buffers);
    ApplySamples(this->Leaves, sampled, this->Law, this->Buffers);
    this->Report.TargetEvaluations += samples.Count;
    this->Report.DroppedSamples += samples.Dropped;
  }
}

/** Samples of another slope go farther, or less far, than those of the largest. */
bool SurfacePasses::TakeSlopesIntoAccount(std::size_t leaf, const StepPlan& plan, double scale)
{
  bool differs = false;
  const auto first = static_cast<std::size_t>(this->Buffers.FirstSample[leaf]);
  for (std::size_t n = first; n < first + this->Leaves[leaf].Crossings; ++n)
  {
    const double ratio = scale * plan.GetRatio(this->Buffers.SlopeSamples[n]);
    this->Buffers.Samples[n] *= static_cast<float>(ratio);
    differs = differs || ratio != 1.0;
  }
  return differs;
}

/** All that are in no share go by the last plan. */
void SurfacePasses::TakeSlopesIntoAccount(const std::vector<LeafShare>& shares)
{
  if (!this->HasTarget())
  {
    return;
  }
  const auto& first = this->Buffers.FirstSample;
  const LeafList sampled = this->Leaves.FindAll(
    [&first](std::size_t i) { return i < first.size() && first[i] != SubstepBuffers::NoSamples; });
  const StepPlan& plan = shares.back().Plan;
  std::vector<const StepPlan*> plans(this->Leaves.Size(), &plan);
  for (const LeafShare& share : shares)
  {
    for (const std::int32_t i : share.Leaves)
    {
      plans[i] = &share.Plan;
    }
  }
  std::atomic<bool> differs{ false };
  this->Leaves.ForEach(sampled,
    [&](std::size_t i)
    {
      if (this->TakeSlopesIntoAccount(i, *plans[i], plans[i]->GetFactor() / plan.GetFactor()))
      {
        differs.store(true, std::memory_order_relaxed);
      }
    });
  if (IsSoOnAny(this->Leaves, differs.load()))
  {
    TellSamples(this->Leaves, sampled, this->Law, this->Buffers);
    ApplySamples(this->Leaves, sampled, this->Law, this->Buffers);
  }
}

/** Displaces these leaves, or leaves that to the stages of the plan. */
void SurfacePasses::MakePass(const LeafList& leaves, const StepPlan& plan)
{
  if (leaves.empty())
  {
    return;
  }
  MoveCoefficients coefficients = CoefficientsOf(this->Law, plan);
  coefficients.Relaxation = static_cast<float>(plan.GetRelaxation(this->FindStrain(leaves, plan)));
  this->Set.Choose(this->Leaves, leaves);
  coefficients.IsBalanced = plan.GetStages() && this->HasTarget() && !coefficients.IsUpwind;
  if (coefficients.IsBalanced)
  {
    FindBalances(this->Leaves, leaves, coefficients, this->IsWeighted(), this->Buffers);
  }
  if (coefficients.HasTargetSpeed || coefficients.Uniform != 0.f || this->IsWeighted())
  {
    FindDisplacements(this->Leaves, this->Set, coefficients, this->Buffers);
    ExtendSpeed(this->Leaves, this->Set, this->Law, this->Buffers);
  }
  else
  {
    ClearDisplacements(this->Leaves, this->Set, this->Buffers);
  }
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
  if (!this->Gradients.Unbounded)
  {
    this->Commit();
  }
}

/** The longest displacement. One that tension goes back strains nothing; but attraction's does, as
 * it differs from place to place. */
float SurfacePasses::FindStrain(const LeafList& leaves, const StepPlan& plan) const
{
  const float displacement =
    LargestDisplacement(leaves, CoefficientsOf(this->Law, plan), this->Buffers);
  return this->HasTarget() || displacement == 0.f
    ? displacement
    : std::min(displacement, this->FindLargestDisplacement(leaves, plan));
}

void SurfacePasses::Count(const GradientCounts& counts)
{
  this->Gradients.Flat += counts.Flat;
  this->Gradients.Steep += counts.Steep;
  this->Gradients.Unbounded = counts.Unbounded;
}

void SurfacePasses::MakeTension(const LeafList& leaves, const StepPlan& plan)
{
  if (leaves.empty() || this->Gradients.Unbounded)
  {
    return;
  }
  this->Set.Choose(this->Leaves, leaves);
  if (this->IsWeighted())
  {
    this->Weights.ExtendToEntered(this->Leaves, this->Set, this->Law, this->Buffers);
  }
  this->Buffers.StageSource.MakeRoom(this->Leaves);
  this->Leaves.ForEach(Without(leaves, this->Sourced),
    [this](std::size_t i) { std::fill_n(this->Buffers.StageSource.Of(i), 512, 0.f); });
  const bool isBounded =
    MakeTensionStages(this->Leaves, this->Set, plan, this->IsWeighted(), this->Buffers);
  this->Gradients.Unbounded = !isBounded;
  if (isBounded)
  {
    this->Commit();
  }
}

/** Takes the next potential; layers and ghosts follow. */
void SurfacePasses::Commit()
{
  ClampToBounds({ this->Law.Box, this->Law.Solid, this->Band.VoxelSize }, this->Leaves, this->Set,
    this->Buffers);
  CommitStep(this->Leaves, this->Set, this->Buffers);
  RebuildLayers(this->Leaves, this->Set, this->Band.Potential);
  if (this->HasTarget())
  {
    FillGhostsAndEntered(this->Leaves, this->Set, this->Buffers.Nodes);
  }
  else
  {
    FillGhosts(this->Leaves, this->Set); // more exact for tension alone
  }
}

}
