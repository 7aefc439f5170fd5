#include "Targets/ParticleTarget.h"

#include "SharedResults.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace activesurface
{

namespace
{

// On a rank, of what it counts.
struct Facts
{
  PlacedCounts Counts;
  double LargestRadius;
};

Facts AddFacts(Agreement& ranks, const Facts& own)
{
  Facts all{};
  for (const Facts& facts : GatherValues(ranks, own))
  {
    all.Counts.Before += facts.Counts.Before;
    all.Counts.After += facts.Counts.After;
    all.Counts.Changed += facts.Counts.Changed;
    all.LargestRadius = std::max(all.LargestRadius, facts.LargestRadius);
  }
  return all;
}

void AddBoxes(Agreement& ranks, std::vector<ChangedRegion::Box>& boxes)
{
  const auto visit = [](std::vector<ChangedRegion::Box>& some, auto& pass)
  { PassVector(some, pass); };
  const auto all = GatherResults(ranks, boxes, visit);
  boxes.clear();
  for (const std::vector<ChangedRegion::Box>& some : all)
  {
    boxes.insert(boxes.end(), some.begin(), some.end());
  }
}

// Where a hollow is, if the particle is at the side of one: a spacing from it or, where its surface
// is farther from it, one and a half.
void VisitHollow(
  const SkeletonVertex& particle, const double outward[3], const RegionVisitor& visit)
{
  TargetRegion region;
  region.Seeds = RegionSeeds::HollowAtCentre;
  for (const double far : { 1.0, 1.5 })
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const double place = particle.Position[axis] + far * outward[axis];
      region.Bounds[2 * axis] = region.Bounds[2 * axis + 1] = place;
    }
    visit(region);
  }
}

}

namespace
{

TargetOptions LevelOf(const ShapeOptions& options)
{
  TargetOptions level = options.Level;
  level.Noise = options.IsOnNodes ? 0.0 : level.Noise;
  return level;
}

}

ParticleTarget::ParticleTarget(const TargetFrames& frames, const ShapeOptions& options)
  : MovingTarget(LevelOf(options))
  , Frames(frames)
  , Options(options)
{
}

void ParticleTarget::KeepNear(const OwnPlaces* places) noexcept
{
  this->Places = places;
  this->TellsRegionsAlone = false;
  this->ForgetNear();
  this->ForgetPlace();
}

// Nor anything of placements, whose origins were among them.
void ParticleTarget::ForgetNear() noexcept
{
  this->StepOfNear = -1;
  this->Near = NearParticles();
  this->Now = PlacedParticles();
  this->Previous = PlacedParticles(); // a copy of nothing would keep its memory
  this->Body = ParticlePotential();
  this->Elements = Skeleton();
}

void ParticleTarget::Place(int step, double fraction)
{
  std::swap(this->Previous, this->Now);
  if (this->TellsRegionsAlone)
  {
    const ParticleFrame& frame = *this->Frames.GetWay(step).Earlier;
    this->FindFits(frame);
    this->Now.Particles = frame.Particles;
    this->Now.Fits = frame.Fits;
    this->Changed.SetEverywhere();
    return;
  }
  PlacedNeeds needs;
  needs.Fits = this->Options.WantsFits();
  this->PlaceWay(step, fraction, needs, this->Now);
  this->FindChanged();
}

// Once for each step of the input.
void ParticleTarget::FindFits(const ParticleFrame& frame) const
{
  FitOptions fit;
  fit.Model = this->Options.Model;
  fit.OwnRadius = frame.HasRadii ? 0.0 : 0.5 * this->Options.SpacingInUse;
  fit.Anisotropy = this->Options.Anisotropy;
  fit.SparesCrowds = !this->Options.NeedsFits();
  frame.FindFits(fit);
}

void ParticleTarget::PlaceWay(
  int step, double fraction, const PlacedNeeds& needs, PlacedParticles& placed)
{
  const ParticleWay whole = this->Frames.GetWay(step);
  for (const ParticleFrame* frame : { whole.Earlier, whole.Later })
  {
    if (frame && needs.Fits)
    {
      this->FindFits(*frame);
    }
  }
  if (whole.IsShared() && (this->StepOfNear != step || this->NearHasFits < needs.Fits))
  {
    this->ChooseNear(whole, step, needs.Fits);
  }
  PlacedNeeds wanted = needs;
  wanted.Duration = this->GetDuration();
  PlaceParticles(whole.IsShared() ? this->Near.GetWay() : whole, fraction, wanted, placed);
  if (!this->Places && wanted.Duration == 0.0) // they stand still, and are many
  {
    this->Near = NearParticles();
    this->StepOfNear = -1;
  }
}

void ParticleTarget::ChooseNear(const ParticleWay& whole, int step, bool hasFits)
{
  this->ForgetNear();
  this->Near.Choose(whole, this->Places);
  this->StepOfNear = step;
  this->NearHasFits = hasFits;
}

void ParticleTarget::Finish()
{
  if (this->TellsRegionsAlone)
  {
    return;
  }
  const double before = this->Body.GetCellSize();
  this->BuildBody(this->Now, this->LargestRadius, this->Elements, this->Body);
  if (!this->IsSum())
  {
    this->NoteCells(before, this->Body.GetCellSize());
  }
}

void ParticleTarget::BuildBody(const PlacedParticles& placed, double largestRadius,
  Skeleton& elements, ParticlePotential& body) const
{
  if (!this->IsSum())
  {
    body.Build(this->Options.Model, placed.Particles, placed.Fits, largestRadius);
    return;
  }
  elements.Clear();
  for (const SkeletonVertex& particle : placed.Particles)
  {
    elements.AddPoint(particle);
  }
  elements.Build();
}

void ParticleTarget::PlaceNodes(double begin, double end, double transport, double voxelSize)
{
  this->VoxelSize = voxelSize;
  const int step = this->GetStepOfWay();
  PlacedNeeds needs;
  needs.Fits = this->Options.NodesNeedFits();
  needs.Velocities = this->Options.Carries;
  this->PlaceWay(step, this->FindFraction(end), needs, this->AtNodes);
  NodeParticleOptions options;
  options.Model = this->Options.Model;
  options.VoxelSize = voxelSize;
  const bool hasRadii =
    this->Frames.GetParticles(step).HasRadii || this->Frames.GetParticles(step + 1).HasRadii;
  options.OwnRadius = hasRadii ? 0.0 : 0.5 * this->Options.SpacingInUse;
  options.ReachPerRadius = hasRadii ? std::max(this->Frames.GetParticles(step).ReachPerRadius,
                                        this->Frames.GetParticles(step + 1).ReachPerRadius)
                                    : 2.0 * GetReachPerSpacing(this->Options.Model);
  options.Anisotropy = this->Options.Anisotropy;
  options.WantsBulks = this->Options.WantsBulks();
  options.Duration = transport * (end - begin);
  options.HasNoise = this->Options.NoiseAtNodes > 0.0;
  this->Nodes.Build(
    { this->AtNodes.Particles, this->AtNodes.Fits, this->AtNodes.Velocities }, options);
  if (this->Options.Model != ParticleModel::Anisotropic)
  {
    this->BuildBody(this->AtNodes, 0.0, this->ElementsAtNodes, this->BodyAtNodes);
  }
}

// Ellipsoids by rows; other models node by node.
void ParticleTarget::EvaluateLeaf(const ShellLeaf& leaf, float* values) const
{
  if (this->Options.Model == ParticleModel::Anisotropic)
  {
    this->Nodes.EvaluateLeaf(leaf, values);
    return;
  }
  double points[3 * 512], found[512];
  std::size_t count = 0;
  const auto visit = [&](auto&& function)
  {
    for (int n = 0; n < 512; ++n)
    {
      if ((leaf.Rows >> (n >> 3)) & 1)
      {
        function(n);
      }
    }
  };
  visit(
    [&](int n)
    {
      points[3 * count] = this->VoxelSize * (leaf.Origin[0] + (n >> 6));
      points[3 * count + 1] = this->VoxelSize * (leaf.Origin[1] + (n >> 3 & 7));
      points[3 * count++ + 2] = this->VoxelSize * (leaf.Origin[2] + (n & 7));
    });
  if (this->IsSum())
  {
    this->ElementsAtNodes.Evaluate(
      this->Options.Kernel, this->GetLevel(), count, points, found, nullptr);
  }
  else
  {
    this->BodyAtNodes.Evaluate(count, points, found, nullptr);
  }
  const double *next = found, level = this->GetLevel(), iso = this->Options.Level.IsoValue;
  const double outside = this->BodyAtNodes.GetOutside() - iso;
  visit(
    [&](int n)
    {
      // The root makes a sum nearly linear, as in ParticleNodes.h.
      const double sum = std::max(level - *next, 0.0) / level;
      values[n] = static_cast<float>(
        this->IsSum() ? 1.0 - std::sqrt(std::sqrt(sum)) : (*next - iso) / outside);
      ++next;
    });
}

// In cells of another size sums are in another order, so that all of them change by rounding.
void ParticleTarget::NoteCells(double before, double now)
{
  if (now != before)
  {
    this->Changed.SetEverywhere();
  }
}

// Sums depend on the particles in reach alone: where these are the same, so are the sums.
void ParticleTarget::FindChanged()
{
  const PlacedChanges changes(this->Previous, this->Now, this->FindNear());
  Facts facts{ changes.Count(), 0.0 };
  if (this->Places)
  {
    facts.LargestRadius = FindLargestRadiusOfActive(this->Now.Particles);
    facts = AddFacts(*this->Options.Ranks, facts);
  }
  this->LargestRadius = facts.LargestRadius;
  const std::size_t all = std::max(facts.Counts.Before, facts.Counts.After);
  if (facts.Counts.Changed > all / 4)
  {
    this->Changed.SetEverywhere(); // to look closer would not pay
    return;
  }
  changes.ListSupports(this->ChangedSupports);
  if (this->Places)
  {
    AddBoxes(*this->Options.Ranks, this->ChangedSupports);
  }
  this->Changed.Set(this->ChangedSupports);
}

void ParticleTarget::VisitRegions(
  std::size_t first, std::size_t end, const RegionVisitor& visit) const
{
  TargetRegion part;
  part.Seeds = RegionSeeds::PartAtCentre;
  for (std::size_t i = first; i < end; ++i)
  {
    if (this->Now.Particles[i].Strength > 0.0)
    {
      const ChangedRegion::Box box = SupportOf(this->Now, i);
      std::copy(box.begin(), box.end(), part.Bounds);
      visit(part);
      if (!this->Now.Fits.empty() && this->Now.Fits[i].IsAtEdge())
      {
        VisitHollow(this->Now.Particles[i], this->Now.Fits[i].Outward, visit);
      }
    }
  }
}

bool ParticleTarget::HasChangedIn(const double bounds[6]) const
{
  return this->Changed.Touches(bounds);
}

void ParticleTarget::Sample(
  std::size_t count, const double* points, double* values, double* gradients) const
{
  if (this->IsSum())
  {
    this->Elements.Evaluate(
      this->Options.Kernel, this->Options.Threshold, count, points, values, gradients);
  }
  else
  {
    this->Body.Evaluate(count, points, values, gradients);
  }
}

}
