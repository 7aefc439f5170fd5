#include "Targets/ParticleTarget.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace activesurface
{

namespace
{

// Visits the points at 1 and 1.5 spacings outward of a particle, where a hollow may be. The second
// is for a surface that is farther from the particle.
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

void ParticleTarget::Place(int step, double fraction)
{
  std::swap(this->Previous, this->Now);
  const bool needsFits = this->Options.WantsFits();
  PlaceParticles(this->MakeTrack(step, fraction, needsFits), needsFits, this->Now);
  this->FindChanged();
}

// Makes the fits of a frame, once for each step of the input.
void ParticleTarget::FindFits(const ParticleFrame& frame) const
{
  FitOptions fit;
  fit.Model = this->Options.Model;
  fit.OwnRadius = frame.HasRadii ? 0.0 : 0.5 * this->Options.SpacingInUse;
  fit.Anisotropy = this->Options.Anisotropy;
  fit.SparesCrowds = !this->Options.NeedsFits();
  activesurface::FindFits(frame, fit, this->Options.Box);
}

ParticleTrack ParticleTarget::MakeTrack(int step, double fraction, bool needsFits) const
{
  ParticleTrack track = this->Frames.GetTrack(step, this->Options.Box, fraction);
  for (const ParticleFrame* frame : { &track.GetEarlier(), track.GetLater() })
  {
    if (frame && needsFits)
    {
      this->FindFits(*frame);
    }
  }
  return track;
}

void ParticleTarget::Finish()
{
  const double before = this->Body.GetCellSize();
  this->BuildBody(this->Now, this->Elements, this->Body);
  if (!this->IsSum())
  {
    this->NoteCells(before, this->Body.GetCellSize());
  }
}

void ParticleTarget::BuildBody(
  const PlacedParticles& placed, Skeleton& elements, ParticlePotential& body) const
{
  if (!this->IsSum())
  {
    body.Build(this->Options.Model, placed.Particles, placed.Fits);
    return;
  }
  elements.Clear();
  for (const SkeletonVertex& particle : placed.Particles)
  {
    elements.AddPoint(particle);
  }
  elements.Build();
}

NodeParticleOptions ParticleTarget::GetNodeOptions(const ShapeOptions& options, double voxelSize)
{
  NodeParticleOptions nodes;
  nodes.Model = options.Model;
  nodes.VoxelSize = voxelSize;
  nodes.OwnRadius = 0.5 * options.SpacingInUse;
  nodes.ReachPerRadius = 2.0 * GetReachPerSpacing(options.Model);
  nodes.Anisotropy = options.Anisotropy;
  nodes.WantsBulks = options.WantsBulks();
  nodes.HasNoise = options.NoiseAtNodes > 0.0;
  nodes.HasVelocities = options.Carries;
  return nodes;
}

void ParticleTarget::PlaceNodes(const NodeMotion& motion)
{
  this->VoxelSize = motion.VoxelSize;
  const int step = this->GetStepOfWay();
  const bool needsFits = this->Options.NodesNeedFits();
  ParticleTrack track = this->MakeTrack(step, this->FindFraction(motion.End), needsFits);
  track.SetDuration(this->GetDuration());
  if (this->Options.Model != ParticleModel::Anisotropic)
  {
    PlaceParticles(track, needsFits, this->AtNodes);
    this->BuildBody(this->AtNodes, this->ElementsAtNodes, this->BodyAtNodes);
    track.SetFits(this->AtNodes.Fits);
  }
  NodeParticleOptions options = GetNodeOptions(this->Options, motion.VoxelSize);
  if (this->Frames.GetParticles(step).HasRadii || this->Frames.GetParticles(step + 1).HasRadii)
  {
    options.OwnRadius = 0.0;
    options.ReachPerRadius = std::max(this->Frames.GetParticles(step).ReachPerRadius,
      this->Frames.GetParticles(step + 1).ReachPerRadius);
  }
  options.Duration = motion.Transport * (motion.End - motion.Begin);
  options.Space = motion.Space;
  this->Nodes.Build(track, options);
}

// Evaluates ellipsoids row by row, other models node by node.
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
      // The fourth root makes a sum nearly linear, as in ParticleNodes.h.
      const double sum = std::max(level - *next, 0.0) / level;
      values[n] = static_cast<float>(
        this->IsSum() ? 1.0 - std::sqrt(std::sqrt(sum)) : (*next - iso) / outside);
      ++next;
    });
}

// If the cell size changes, the order of the sums changes, and with it the rounding of all sums.
void ParticleTarget::NoteCells(double before, double now)
{
  if (now != before)
  {
    this->Changed.SetEverywhere();
  }
}

// Finds where particles have changed. Sums elsewhere are unchanged, as they depend only on the
// particles whose support contains the point.
void ParticleTarget::FindChanged()
{
  if (this->Options.Box.Any())
  {
    this->Changed.SetEverywhere(); // copies of a particle have no unique match
    return;
  }
  const PlacedChanges changes(this->Previous, this->Now);
  const PlacedCounts counts = changes.Count();
  if (counts.Changed > std::max(counts.Before, counts.After) / 4)
  {
    this->Changed.SetEverywhere(); // a closer test would cost more than it saves
    return;
  }
  changes.ListSupports(this->ChangedSupports);
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
