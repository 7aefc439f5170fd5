#include "Simulation/TargetCoverage.h"

#include "NarrowBand.h"
#include "Obstacle.h"
#include "SharedResults.h"
#include "Simulation/SurfaceSettings.h"
#include "Simulation/TargetBuilder.h"

#include <algorithm>
#include <cmath>

namespace activesurface
{

namespace
{

constexpr std::size_t EnoughInside = 4096;
constexpr int PointsPerBatch = 4096;
constexpr int MostBatches = 16;

// Point number i is at the fractional parts of 1/2 + i times these: powers of 1/x, x^4 = x + 1,
// which spread evenly at any count (a Kronecker sequence in three dimensions).
constexpr double Steps[3] = { 0.8191725133961645, 0.6710436067037893, 0.5497004779019703 };

std::vector<double> SpreadPoints(const double bounds[6], int batch)
{
  std::vector<double> points(std::size_t(3) * PointsPerBatch);
  for (int i = 0; i < PointsPerBatch; ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const double along = 0.5 + (double(batch) * PointsPerBatch + i) * Steps[axis];
      const double low = bounds[2 * axis], high = bounds[2 * axis + 1];
      points[3 * i + axis] = low + (along - std::floor(along)) * (high - low);
    }
  }
  return points;
}

PointWithMargin MakePoint(const double x[3], double margin)
{
  return { { x[0], x[1], x[2] }, margin };
}

}

TargetCoverage::TargetCoverage(const SurfaceSettings& settings, const TargetBuilder& shapes)
  : Settings(settings)
  , Shapes(shapes)
{
}

void TargetCoverage::Clear()
{
  this->Points.clear();
  this->ArePointsKnown = false;
}

bool TargetCoverage::IsStatic() const
{
  return !this->Settings.UsesInput() || !this->Settings.Inputs.TargetMoves;
}

double TargetCoverage::FindOutside(const NarrowBand& band, const Motion& motion, int step)
{
  if (!this->ArePointsKnown)
  {
    this->Points = this->FindPoints(this->IsStatic() ? 0 : step, band.GetVoxelSize());
    const auto isBeyond = [&motion](const PointWithMargin& point)
    {
      return (motion.Box.Present && DistanceToWalls(motion.Box, point.Position) > 0.0) ||
        (motion.Solid && motion.Solid->DepthAt(point.Position) > 0.0);
    };
    this->Points.erase(
      std::remove_if(this->Points.begin(), this->Points.end(), isBeyond), this->Points.end());
  }
  const Counts counts = this->AddUp({ CountOutside(band, this->Points), this->Points.size() });
  this->ArePointsKnown = this->IsStatic();
  if (!this->ArePointsKnown)
  {
    this->Points = {};
  }
  return counts.Outside > 0 ? double(counts.Outside) / double(counts.All) : 0.0;
}

std::vector<PointWithMargin> TargetCoverage::FindPoints(int step, double voxelSize)
{
  const InputShape* shape =
    this->Settings.UsesInput() ? this->Shapes.GetFrames().Find(step) : nullptr;
  const ParticleFrame* frame = shape ? shape->GetPoints() : nullptr;
  this->ArePointsShared = frame && this->Ranks && !this->Ranks->IsAlone();
  return frame ? this->FindParticles(*frame) : this->FindInside(step, voxelSize);
}

// Of ranks, each finds those that it has; of points that all have, those of a range.
std::vector<PointWithMargin> TargetCoverage::FindParticles(const ParticleFrame& frame) const
{
  const double spacing = this->Shapes.FindSpacing();
  const double reach = GetReachPerSpacing(this->Settings.Particles.Model);
  const bool areAllHere = this->ArePointsShared && !frame.Shared;
  const std::size_t ranks = areAllHere ? this->Ranks->GetSize() : 1;
  const std::size_t rank = areAllHere ? this->Ranks->GetRank() : 0;
  const RankRanges ranges{ frame.Particles.size(), ranks };
  std::vector<PointWithMargin> points;
  points.reserve(ranges.FirstOf(rank + 1) - ranges.FirstOf(rank));
  for (std::size_t i = ranges.FirstOf(rank); i < ranges.FirstOf(rank + 1); ++i)
  {
    const SkeletonVertex& particle = frame.Particles[i];
    const double own = frame.HasRadii ? particle.Radius / frame.ReachPerRadius
      : spacing > 0.0                 ? 0.5 * spacing
                                      : 0.5 * particle.Radius / reach;
    if (particle.Strength > 0.0)
    {
      points.push_back(MakePoint(particle.Position, own));
    }
  }
  return points;
}

TargetCoverage::Counts TargetCoverage::AddUp(const Counts& own) const
{
  if (!this->ArePointsShared)
  {
    return own;
  }
  Counts sum;
  for (const Counts& ofRank : GatherValues(*this->Ranks, own))
  {
    sum.Outside += ofRank.Outside;
    sum.All += ofRank.All;
  }
  return sum;
}

std::vector<PointWithMargin> TargetCoverage::FindInside(int step, double voxelSize) const
{
  std::vector<PointWithMargin> points;
  const vtkBoundingBox box = this->Shapes.FindBoundsOfInside(step);
  if (!box.IsValid())
  {
    return points;
  }
  double bounds[6];
  box.GetBounds(bounds);
  const std::unique_ptr<PotentialTarget> target = this->Shapes.MakeTargetAt(step, 0.0, 0.0);
  std::vector<double> values(PointsPerBatch);
  for (int batch = 0; batch < MostBatches && points.size() < EnoughInside; ++batch)
  {
    const std::vector<double> places = SpreadPoints(bounds, batch);
    target->EvaluateLevel(values.size(), places.data(), values.data());
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      if (values[i] < 0.0)
      {
        points.push_back(MakePoint(places.data() + 3 * i, voxelSize));
      }
    }
  }
  return points;
}

}
