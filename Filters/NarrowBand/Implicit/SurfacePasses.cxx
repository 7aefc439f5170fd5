#include "Implicit/SurfacePasses.h"

#include "Implicit/TensionStages.h"
#include "Leaves/GhostFill.h"
#include "Leaves/Layers.h"
#include "Leaves/LeafLists.h"
#include "Substep/SamplePoints.h"
#include "Substep/SubstepBuffers.h"
#include "Substep/TargetSpeed.h"
#include "Substep/WalledTarget.h"

#include <algorithm>
#include <iterator>

namespace activesurface
{

WayCoefficients CoefficientsOf(const Motion& law, const StepPlan& plan)
{
  const bool hasTarget = law.Attraction > 0.0;
  WayCoefficients coefficients;
  coefficients.HasTargetSpeed = hasTarget;
  // Details of a target that the lattice cannot hold make a surface rougher for ever by central
  // gradients, where tension is too weak to smooth them: its length is below a quarter of a voxel.
  coefficients.IsUpwind = hasTarget && 16.0 * plan.GetTension() < plan.GetDamping();
  coefficients.Factor = hasTarget ? static_cast<float>(plan.GetFactor()) : 0.f;
  coefficients.Uniform = static_cast<float>(plan.GetUniformWay());
  coefficients.SourcePerWay = static_cast<float>(plan.GetSourcePerWay());
  coefficients.Tension = static_cast<float>(plan.GetTension() / plan.GetSourcePerWay());
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

float SurfacePasses::FindLargestWay(const LeafList& leaves, const StepPlan& plan) const
{
  const WayCoefficients coefficients = CoefficientsOf(this->Law, plan);
  return plan.GetStages()
    ? LargestNetWay(this->Leaves, leaves, coefficients, this->IsWeighted(), this->Buffers)
    : LargestWay(leaves, coefficients, this->Buffers);
}

GradientCounts SurfacePasses::Run(const StepPlan& plan)
{
  this->Gradients = {};
  this->Moved = this->Set.Active;
  this->Sourced.clear();
  this->Displace(LeafList(this->Moved), plan, 0);
  this->MakeTension(plan);
  return this->Gradients;
}

/** plan: of the substep, or of its way halved so often. */
void SurfacePasses::Displace(const LeafList& leaves, const StepPlan& plan, int halvings)
{
  const WayCoefficients coefficients = CoefficientsOf(this->Law, plan);
  this->TakeSlopesIntoAccount(plan);
  LeafList fast;
  std::copy_if(leaves.begin(), leaves.end(), std::back_inserter(fast),
    [&](std::int32_t i)
    { return halvings < MostHalvings && WayOf(i, coefficients, this->Buffers) > LongestWay; });
  LeafList region = this->Leaves.FindAround(fast);
  region = halvings == 0 ? region : Intersection(region, leaves);
  this->MakePass(Without(leaves, region), plan);
  for (int half = 0; half < 2 && !region.empty() && !this->Gradients.Unbounded; ++half)
  {
    const std::size_t before = this->Leaves.Size();
    this->SampleAgain(region);
    this->Displace(region, plan.HalveWay(), halvings + 1);
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
void SurfacePasses::TakeSlopesIntoAccount(const StepPlan& plan)
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
void SurfacePasses::MakePass(const LeafList& leaves, const StepPlan& plan)
{
  if (leaves.empty())
  {
    return;
  }
  WayCoefficients coefficients = CoefficientsOf(this->Law, plan);
  coefficients.Relaxation = static_cast<float>(plan.GetRelaxation(this->FindStrain(leaves, plan)));
  this->Set.Choose(this->Leaves, leaves);
  if (coefficients.HasTargetSpeed || coefficients.Uniform != 0.f || this->IsWeighted())
  {
    FindWays(this->Leaves, this->Set, coefficients, this->Buffers);
    ExtendSpeed(this->Leaves, this->Set, this->Law, this->Buffers);
  }
  else
  {
    ClearWays(this->Leaves, this->Set, this->Buffers);
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

/** The longest way. One that tension goes back strains nothing; but attraction's does, as it
 * differs from place to place. */
float SurfacePasses::FindStrain(const LeafList& leaves, const StepPlan& plan) const
{
  const float way = LargestWay(leaves, CoefficientsOf(this->Law, plan), this->Buffers);
  return this->HasTarget() || way == 0.f ? way : std::min(way, this->FindLargestWay(leaves, plan));
}

void SurfacePasses::Count(const GradientCounts& counts)
{
  this->Gradients.Flat += counts.Flat;
  this->Gradients.Steep += counts.Steep;
  this->Gradients.Unbounded = counts.Unbounded;
}

void SurfacePasses::MakeTension(const StepPlan& plan)
{
  if (!plan.GetStages() || this->Gradients.Unbounded)
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
