#include "Simulation/TargetCoverage.h"

#include "NarrowBand.h"
#include "Obstacle.h"
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
  const std::size_t outside = CountOutside(band, this->Points), all = this->Points.size();
  this->ArePointsKnown = this->IsStatic();
  if (!this->ArePointsKnown)
  {
    this->Points = {};
  }
  return outside > 0 ? double(outside) / double(all) : 0.0;
}

std::vector<PointWithMargin> TargetCoverage::FindPoints(int step, double voxelSize)
{
  const InputShape* shape =
    this->Settings.UsesInput() ? this->Shapes.GetFrames().Find(step) : nullptr;
  const ParticleFrame* frame = shape ? shape->GetPoints() : nullptr;
  return frame ? this->FindParticles(*frame) : this->FindInside(step, voxelSize);
}

std::vector<PointWithMargin> TargetCoverage::FindParticles(const ParticleFrame& frame) const
{
  const double spacing = this->Shapes.FindSpacing();
  const double reach = GetReachPerSpacing(this->Settings.Particles.Model);
  std::vector<PointWithMargin> points;
  points.reserve(frame.Particles.size());
  for (const SkeletonVertex& particle : frame.Particles)
  {
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
