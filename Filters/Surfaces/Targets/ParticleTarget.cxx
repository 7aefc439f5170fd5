#include "Targets/ParticleTarget.h"

#include <algorithm>
#include <cmath>

namespace activesurface
{

namespace
{

// Visits the points at 1 and 1.5 own diameters outward of a particle, where a hollow may be. The
// second point is for a surface that is farther from the particle.
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

TargetOptions LevelOf(const TargetOptions& options)
{
  TargetOptions level = options;
  level.Noise = options.IsOnNodes ? 0.0 : level.Noise;
  return level;
}

void SetElements(const std::vector<SkeletonVertex>& particles, Skeleton& elements)
{
  elements.Clear();
  for (const SkeletonVertex& particle : particles)
  {
    elements.AddPoint(particle);
  }
  elements.Build();
}

void FindSupport(const SkeletonVertex& particle, double (&bounds)[6])
{
  for (int side = 0; side < 6; ++side)
  {
    bounds[side] = particle.Position[side / 2] + (side % 2 == 0 ? -1.0 : 1.0) * particle.Radius;
  }
}

}

ParticleTarget::ParticleTarget(const TargetFrames& frames, const TargetOptions& options)
  : MovingTarget(LevelOf(options))
  , Frames(frames)
{
}

void ParticleTarget::Place(int step, double fraction)
{
  this->Frames.GetTrack(step, this->GetOptions().Box, fraction).List(this->Now);
}

double ParticleTarget::FindOwnRadius(int step, double& reachPerRadius) const
{
  const ParticleFrame &earlier = this->Frames.GetParticles(step),
                      &later = this->Frames.GetParticles(step + 1);
  const bool haveRadii = earlier.HasRadii || later.HasRadii;
  reachPerRadius = haveRadii ? std::max(earlier.ReachPerRadius, later.ReachPerRadius)
                             : 2.0 * GetReachPerSpacing(this->GetOptions().Model);
  return haveRadii ? 0.0 : 0.5 * this->GetOptions().Spacing;
}

void ParticleTarget::Finish()
{
  if (this->IsSum())
  {
    SetElements(this->Now, this->Elements);
  }
  if (!this->IsSum() || this->GetOptions().OpensHollows)
  {
    NodeParticleOptions options = GetNodeOptions(this->GetOptions(), 1.0);
    options.OwnRadius = this->FindOwnRadius(this->GetFirstStep(), options.ReachPerRadius);
    this->Body.Build(this->Now, options);
  }
}

NodeParticleOptions ParticleTarget::GetNodeOptions(const TargetOptions& options, double voxelSize)
{
  NodeParticleOptions nodes;
  nodes.Model = options.Model;
  nodes.VoxelSize = voxelSize;
  nodes.OwnRadius = 0.5 * options.Spacing;
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
  const int step = this->GetFirstStep();
  ParticleTrack track =
    this->Frames.GetTrack(step, this->GetOptions().Box, this->FindFraction(motion.End));
  track.SetDuration(this->GetDuration());
  if (this->IsSum())
  {
    track.List(this->AtNodes);
    SetElements(this->AtNodes, this->ElementsAtNodes);
  }
  NodeParticleOptions options = GetNodeOptions(this->GetOptions(), motion.VoxelSize);
  options.OwnRadius = this->FindOwnRadius(step, options.ReachPerRadius);
  options.Duration = motion.Transport * (motion.End - motion.Begin);
  options.Space = motion.Space;
  this->Nodes.Build(track, options);
}

// Evaluates ellipsoids row by row, and a sum of kernels node by node.
void ParticleTarget::EvaluateLeaf(const ShellLeaf& leaf, float* values) const
{
  if (!this->IsSum())
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
  this->ElementsAtNodes.Evaluate(
    this->GetOptions().Kernel, this->GetLevel(), count, points, found, nullptr);
  const double *next = found, level = this->GetLevel();
  visit(
    [&](int n)
    {
      // The fourth root makes a sum nearly linear, as in ParticleNodes.h.
      const double sum = std::max(level - *next++, 0.0) / level;
      values[n] = static_cast<float>(1.0 - std::sqrt(std::sqrt(sum)));
    });
}

void ParticleTarget::VisitRegions(
  std::size_t first, std::size_t end, const RegionVisitor& visit) const
{
  TargetRegion part;
  part.Seeds = RegionSeeds::PartAtCentre;
  for (std::size_t i = first; i < end; ++i)
  {
    const SkeletonVertex& particle = this->Now[i];
    if (!(particle.Strength > 0.0))
    {
      continue;
    }
    if (this->IsSum() || !this->Body.FindSupport(i, part.Bounds))
    {
      FindSupport(particle, part.Bounds);
    }
    visit(part);
    double outward[3];
    if ((!this->IsSum() || this->GetOptions().OpensHollows) && this->Body.FindOutward(i, outward))
    {
      VisitHollow(particle, outward, visit);
    }
  }
}

void ParticleTarget::Sample(
  std::size_t count, const double* points, double* values, double* gradients) const
{
  if (this->IsSum())
  {
    this->Elements.Evaluate(
      this->GetOptions().Kernel, this->GetOptions().Threshold, count, points, values, gradients);
  }
  else
  {
    this->Body.Evaluate(count, points, values, gradients);
  }
}

}
