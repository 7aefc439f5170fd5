#include "Simulation/TargetCoverage.h"

#include "BandPart.h"
#include "Base/Obstacle.h"
#include "NarrowBand.h"
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

// The coordinates of point i are the fractional parts of 1/2 + i * Steps (a Kronecker sequence in
// three dimensions). Steps are powers of 1/x with x^4 = x + 1, which spread any number of points
// evenly.
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

// Removes points beyond walls or in the obstacle.
std::vector<PointWithMargin> Within(const Motion& motion, std::vector<PointWithMargin> points)
{
  const auto isBeyond = [&motion](const PointWithMargin& point)
  {
    return (motion.Box.Present && DistanceToWalls(motion.Box, point.Position) > 0.0) ||
      (motion.Solid && motion.Solid->DepthAt(point.Position) > 0.0);
  };
  points.erase(std::remove_if(points.begin(), points.end(), isBeyond), points.end());
  return points;
}

struct Found
{
  std::size_t Outside = 0, All = 0;

  void operator+=(const Found& other)
  {
    this->Outside += other.Outside;
    this->All += other.All;
  }
  double GetShare() const
  {
    return this->Outside > 0 ? double(this->Outside) / double(this->All) : 0.0;
  }
};

Found Count(const NarrowBand& band, const std::vector<PointWithMargin>& points)
{
  return { CountOutside(band, points), points.size() };
}

// Removes the points in space of other ranks.
std::vector<PointWithMargin> KeepOwn(const NarrowBand& band, std::vector<PointWithMargin> points)
{
  if (const BandPart* part = band.GetPart())
  {
    const auto isForeign = [&](const PointWithMargin& point)
    { return !part->Space->IsOwn(NodeBelow(point.Position, band.GetVoxelSize())); };
    points.erase(std::remove_if(points.begin(), points.end(), isForeign), points.end());
  }
  return points;
}

// Adds up the counts of all ranks. Collective if the band is a part.
Found AddUp(const NarrowBand& band, const Found& own)
{
  if (!band.GetPart())
  {
    return own;
  }
  Found all;
  for (const Found& found : band.GetPart()->GetRanks().ExchangeValue(own))
  {
    all += found;
  }
  return all;
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
  const ParticleFrame* frame = this->FindFrame(step);
  if (frame && !this->IsStatic())
  {
    constexpr std::size_t inPiece = std::size_t(1) << 16;
    Found found;
    for (std::size_t first = 0; first < frame->Particles.size(); first += inPiece)
    {
      const std::size_t end = std::min(first + inPiece, frame->Particles.size());
      found += Count(band, KeepOwn(band, Within(motion, this->ListParticles(*frame, first, end))));
    }
    return AddUp(band, found).GetShare();
  }
  if (!this->ArePointsKnown)
  {
    frame = this->FindFrame(this->IsStatic() ? 0 : step);
    this->Points = Within(motion,
      frame ? this->ListParticles(*frame, 0, frame->Particles.size())
            : this->FindInside(this->IsStatic() ? 0 : step, band.GetVoxelSize()));
    this->ArePointsKnown = this->IsStatic();
  }
  return Count(band, this->Points).GetShare();
}

// Returns null for an inverted target, whose inside is between the points.
const ParticleFrame* TargetCoverage::FindFrame(int step) const
{
  const InputShape* shape = this->Settings.UsesInput() && !this->Settings.Invert
    ? this->Shapes.GetFrames().Find(step)
    : nullptr;
  return shape ? shape->GetPoints() : nullptr;
}

std::vector<PointWithMargin> TargetCoverage::ListParticles(
  const ParticleFrame& frame, std::size_t first, std::size_t end) const
{
  const double spacing = this->Shapes.FindSpacing();
  const double reach = GetReachPerSpacing(this->Settings.Particles.Model);
  const PeriodicBox box = this->Shapes.GetBox();
  std::vector<PointWithMargin> points;
  points.reserve(end - first);
  for (std::size_t i = first; i < end; ++i)
  {
    SkeletonVertex particle = frame.Particles[i];
    const double own = frame.HasRadii ? particle.Radius / frame.ReachPerRadius
      : spacing > 0.0                 ? 0.5 * spacing
                                      : 0.5 * particle.Radius / reach;
    if (particle.Strength > 0.0)
    {
      box.Wrap(particle.Position);
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
