#include "Targets/ParticleTarget.h"

#include "ParallelTasks.h"

#include <algorithm>
#include <atomic>
#include <utility>

namespace activesurface
{

namespace
{

bool IsSameVertex(const SkeletonVertex& a, const SkeletonVertex& b)
{
  return std::equal(a.Position, a.Position + 3, b.Position) && a.Radius == b.Radius &&
    a.Strength == b.Strength;
}

bool IsSameFit(const ParticleFit& a, const ParticleFit& b)
{
  return a.Bulk == b.Bulk && a.OwnRadius == b.OwnRadius && a.Strength == b.Strength &&
    a.Reach == b.Reach && std::equal(a.Offset, a.Offset + 3, b.Offset) &&
    std::equal(a.Metric, a.Metric + 6, b.Metric);
}

// Unknown ones are alike.
bool IsSameVelocity(const double* a, const double* b)
{
  return std::equal(a, a + 3, b, [](double u, double v) { return u == v || (u != u && v != v); });
}

ChangedRegion::Box SupportOf(const PlacedParticles& placed, std::size_t i)
{
  const SkeletonVertex& particle = placed.Particles[i];
  const bool hasFit = !placed.Fits.empty();
  const double reach = hasFit ? std::max(particle.Radius, placed.Fits[i].Reach) : particle.Radius;
  ChangedRegion::Box box;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double offset = hasFit ? placed.Fits[i].Offset[axis] : 0.0;
    box[2 * axis] = particle.Position[axis] + std::min(offset, 0.0) - reach;
    box[2 * axis + 1] = particle.Position[axis] + std::max(offset, 0.0) + reach;
  }
  return box;
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

ParticleTarget::ParticleTarget(const TargetFrames& frames, const ShapeOptions& options)
  : MovingTarget(options.Level)
  , Frames(frames)
  , Options(options)
{
}

void ParticleTarget::Place(int step, double fraction)
{
  PlacedNeeds needs;
  needs.Fits = this->Options.WantsFits();
  needs.Velocities = this->Options.Carries;
  needs.Duration = this->GetDuration();
  needs.LeavesNoise = this->Options.Level.Noise > 0.0;
  needs.Ranks = this->Options.Ranks;
  std::swap(this->Previous, this->Now);
  this->Frames.PlaceParticles(step, fraction, needs, this->Now);
  this->FindChanged();
  if (this->Options.Carries || (this->IsSum() && this->Options.WantsBulks()))
  {
    const double before = this->Means.GetCellSize();
    this->Means.Build(this->Now.Particles, { this->Now.Velocities, this->Now.Fits });
    this->NoteCells(before, this->Means.GetCellSize());
  }
}

void ParticleTarget::Finish()
{
  if (this->IsSum())
  {
    this->Elements.Clear();
    for (const SkeletonVertex& particle : this->Now.Particles)
    {
      this->Elements.AddPoint(particle);
    }
    this->Elements.Build();
    return;
  }
  const double before = this->Body.GetCellSize();
  this->Body.Build(this->Options.Model, this->Now.Particles, this->Now.Fits);
  this->NoteCells(before, this->Body.GetCellSize());
}

// In cells of another size sums are in another order, so that all of them change by rounding.
void ParticleTarget::NoteCells(double before, double now)
{
  if (now != before)
  {
    this->Changed.SetEverywhere();
  }
}

bool ParticleTarget::IsSame(std::size_t i) const
{
  const PlacedParticles& then = this->Previous;
  const PlacedParticles& now = this->Now;
  return i < then.Particles.size() && i < now.Particles.size() &&
    IsSameVertex(then.Particles[i], now.Particles[i]) &&
    (now.Fits.empty() || IsSameFit(then.Fits[i], now.Fits[i])) &&
    (now.Velocities.empty() ||
      IsSameVelocity(then.Velocities.data() + 3 * i, now.Velocities.data() + 3 * i));
}

// Sums depend on the particles in reach alone: where these are the same, so are the sums.
void ParticleTarget::FindChanged()
{
  const std::size_t before = this->Previous.Particles.size(), now = this->Now.Particles.size();
  const std::size_t all = std::max(before, now);
  this->ChangedSupports.clear();
  if (this->CountChanged(all) > all / 4)
  {
    this->Changed.SetEverywhere(); // to look closer would not pay
    return;
  }
  for (std::size_t i = 0; i < all; ++i)
  {
    if (this->IsSame(i))
    {
      continue;
    }
    if (i < before)
    {
      this->ChangedSupports.push_back(SupportOf(this->Previous, i));
    }
    if (i < now)
    {
      this->ChangedSupports.push_back(SupportOf(this->Now, i));
    }
  }
  this->Changed.Set(this->ChangedSupports);
}

std::size_t ParticleTarget::CountChanged(std::size_t all) const
{
  constexpr std::size_t inPiece = 4096;
  std::atomic<std::size_t> changed{ 0 };
  RunPieces(all, inPiece,
    [&](std::size_t begin, std::size_t end)
    {
      std::size_t own = 0;
      for (std::size_t i = begin; i < end; ++i)
      {
        own += this->IsSame(i) ? 0 : 1;
      }
      changed.fetch_add(own, std::memory_order_relaxed);
    });
  return changed;
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

void ParticleTarget::EvaluateVelocities(
  std::size_t count, const double* points, double* velocities) const
{
  this->Means.Evaluate(count, points, velocities, nullptr);
}

void ParticleTarget::SampleMoving(std::size_t count, const double* points, double* values,
  double* gradients, double* velocities, double* weights) const
{
  if (weights && !this->IsSum())
  {
    this->Body.EvaluateWithBulk(count, points, values, gradients, weights);
    weights = nullptr;
  }
  else
  {
    this->Sample(count, points, values, gradients);
  }
  if (velocities || weights)
  {
    this->Means.Evaluate(count, points, velocities, weights);
  }
}

}
