// Motion by Attraction, with little or no tension: the surface follows a target, static or moving.

#include "Support/RandomShapes.h"
#include "Support/SurfaceMeasures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

using namespace activesurface;

namespace TestTracking
{
std::string Number(double value)
{
  return std::to_string(value).substr(0, 5);
}

// V = 1 or -1 everywhere moves a sphere by t. The ghosts' error remains, a tenth of a voxel.
void CheckUniformSpeed(int n, const Point& centre, double from, double to)
{
  const double h = VoxelSizeOf(n);
  NarrowBand band(h);
  StartOn(band, MakeBall(centre, from));
  ShapeTarget target(MakeConstant(to > from ? -1.0 : 1.0));
  band.Advance(std::abs(to - from), MakeMotion(1.0, 0.0), target);
  const Range radii = GetRadii(Polygonise(band), centre);
  const std::string name =
    "n = " + std::to_string(n) + ", from " + Number(from) + " to " + Number(to);
  EXPECT_NEAR((radii.Mean - to) / h, 0.0, 0.15) << "error of the mean radius [h], " << name;
  EXPECT_LT(radii.GetSpread() / h, 0.25) << "spread of the radii [h], " << name;
}

TEST(TestTracking, UniformSpeedMovesASphereByTheTime)
{
  for (const int n : { 32, 64, 128 })
  {
    CheckUniformSpeed(n, CentreA, 0.3, 0.6);
    CheckUniformSpeed(n, CentreA, 0.6, 0.3);
  }
  CheckUniformSpeed(32, CentreB, 0.25, 0.6);
  CheckUniformSpeed(32, CentreB, 0.6, 0.25);
}

TEST(TestTracking, UniformSpeedMovesASphereByTheTimeAtRandom)
{
  RandomShapes random(4);
  for (const int n : { 32, 32, 64 })
  {
    const Ball small = random.DrawBallNear({ CentreA, 0.3 });
    const Ball large = random.DrawBallNear({ CentreA, 0.6 });
    CheckUniformSpeed(n, small.Centre, small.Radius, large.Radius);
    CheckUniformSpeed(n, large.Centre, large.Radius, small.Radius);
  }
}

// dr/dt = a (R - r): r = R + (r0 - R) e^(-a t). Frames of 0.1 limit the forward Euler step to 0.1.
// The error of this step is up to 0.5 a dt (R - r0) e^-1 = 0.0037 = 0.06 h at n = 32, 0.12 h at n =
// 64.
void CheckApproach(int n, const Ball& from, double to, double tolerance)
{
  const double h = VoxelSizeOf(n);
  NarrowBand band(h);
  StartOn(band, MakeBall(from.Centre, from.Radius));
  ShapeTarget target(MakeBall(from.Centre, to));
  double largest = 0.0;
  for (int frame = 1; frame <= 40; ++frame)
  {
    band.Advance(0.1 * frame, MakeMotion(1.0, 0.0), target);
    const double exact = to + (from.Radius - to) * std::exp(-0.1 * frame);
    const double mean = GetRadii(Polygonise(band), from.Centre).Mean;
    largest = std::max(largest, std::abs(mean - exact) / h);
  }
  EXPECT_LT(largest, tolerance) << "largest error of the radius [h], n = " << n;
}

TEST(TestTracking, ApproachToABallIsExponential)
{
  CheckApproach(32, { CentreA, 0.4 }, 0.6, 0.1);
  CheckApproach(64, { CentreA, 0.4 }, 0.6, 0.2);
}

// The distance is at most 1.5 times that above: errors of 0.09 h at n = 32, 0.18 h at n = 64.
TEST(TestTracking, ApproachToABallIsExponentialAtRandom)
{
  RandomShapes random(5);
  for (const auto& [n, tolerance] : { std::pair(32, 0.1), std::pair(32, 0.1), std::pair(64, 0.2) })
  {
    const Ball from = random.DrawBallNear({ CentreA, 0.4 });
    CheckApproach(n, from, random.DrawLengthNear(0.6), tolerance);
  }
}

void CheckJourney(int n, double from, const Shape& to, double time, double exact)
{
  const double h = VoxelSizeOf(n);
  NarrowBand band(h);
  StartOn(band, MakeBall(CentreA, from));
  ShapeTarget target(to);
  band.Advance(time, MakeMotion(1.0, 0.0), target);
  const Range radii = GetRadii(Polygonise(band), CentreA);
  const Range slopes = GetSlopes(band);
  const std::string name = "n = " + std::to_string(n) + ", from " + Number(from) + " to " +
    Number(exact) + " in " + Number(time);
  EXPECT_NEAR((radii.Mean - exact) / h, 0.0, 0.25) << "error of the mean radius [h], " << name;
  EXPECT_LT(radii.GetSpread() / h, 0.25) << "spread of the radii [h], " << name;
  EXPECT_GT(slopes.Minimum, 0.5) << "least slope, " << name;
  EXPECT_LT(slopes.Maximum, 1.5) << "largest slope, " << name;
}

// The surface moves by ten voxels and more at the largest stable time step. In 20 to 60 substeps
// any instability would become visible.
TEST(TestTracking, LongJourneyLeavesABallSmooth)
{
  for (const int n : { 64, 128 })
  {
    const double approach = 0.6 * std::exp(-1.0);
    CheckJourney(n, 0.2, MakeBall(CentreA, 0.8), 1.0, 0.8 - approach);
    CheckJourney(n, 0.8, MakeBall(CentreA, 0.2), 1.0, 0.2 + approach);
    // A distance that is limited to 0.1 moves the surface by at most 0.1 per unit of time.
    CheckJourney(n, 0.2, Normalise(MakeBall(CentreA, 0.75), 0.1), 4.0, 0.6);
    CheckJourney(n, 0.7, Normalise(MakeBall(CentreA, 0.15), 0.1), 4.0, 0.3);
  }
}

struct Tips
{
  double Leading = -1e30;
  double Trailing = 1e30;
};

// Foremost and hindmost sample points within 2 voxels of the axis y = cy, z = cz.
Tips FindTips(const Mesh& mesh, const Point& centre)
{
  Tips tips;
  for (std::size_t vertex = 0; vertex < mesh.GetNumberOfPoints(); ++vertex)
  {
    const Point point = mesh.GetPoint(vertex);
    if (std::abs(point[1] - centre[1]) + std::abs(point[2] - centre[2]) < 0.12)
    {
      tips.Leading = std::max(tips.Leading, point[0]);
      tips.Trailing = std::min(tips.Trailing, point[0]);
    }
  }
  return tips;
}

// The skin follows a ball of speed U at the distance U/a (1 - e^(-a t)), at the front and at the
// back. Tolerance 0.12 h: 0.04 h because a sample point is up to 0.7 h off the axis, the rest for
// the error of frames of 0.01.
void CheckLag(const Ball& start, double attraction)
{
  const double h = VoxelSizeOf(32);
  const auto centreAt = [&start](double time) {
    return Point{ start.Centre[0] + 0.8 * time, start.Centre[1], start.Centre[2] };
  };
  NarrowBand band(h);
  StartOn(band, MakeBall(start.Centre, start.Radius));
  ShapeTarget target([&](double time) { return MakeBall(centreAt(time), start.Radius); });
  for (int frame = 1; frame <= 100; ++frame)
  {
    band.Advance(0.01 * frame, MakeMotion(attraction, 0.0), target);
  }
  const Point centre = centreAt(1.0);
  const Tips tips = FindTips(Polygonise(band), centre);
  const double lag = 0.8 / attraction * (1.0 - std::exp(-attraction));
  const double before = centre[0] + start.Radius - tips.Leading;
  const double behind = centre[0] - start.Radius - tips.Trailing;
  const std::string name = "attraction " + Number(attraction);
  EXPECT_NEAR((before - lag) / h, 0.0, 0.12) << "lag before [h], " << name;
  EXPECT_NEAR((behind - lag) / h, 0.0, 0.12) << "lag behind [h], " << name;
}

TEST(TestTracking, SurfaceLagsBehindAMovingBallByTheExactDistance)
{
  for (const double attraction : { 2.0, 5.0, 10.0, 20.0, 50.0 })
  {
    CheckLag({ { -0.4, 0.013, -0.007 }, 0.4 }, attraction);
  }
}

// The front lags by 0.346 with attraction 2. At a radius of 0.36, its tip would be near the centre
// of the target, where the distance has a kink that is too sharp for the lattice.
TEST(TestTracking, SurfaceLagsBehindAMovingBallByTheExactDistanceAtRandom)
{
  RandomShapes random(12);
  for (const double attraction : { 2.0, 2.0, 5.0, 10.0, 20.0, 50.0 })
  {
    const Point centre = random.DrawPointNear({ -0.4, 0.013, -0.007 });
    CheckLag({ centre, random.DrawBetween(0.4, 0.44) }, attraction);
  }
}

ShapeTarget::Trajectory MakeShuttlingBall(const Ball& start)
{
  return [start](double time)
  {
    const double phase = std::fmod(time, 2.0);
    Point centre = start.Centre;
    centre[0] += 0.8 * std::min(phase, 2.0 - phase);
    return MakeBall(centre, start.Radius);
  };
}

ShapeTarget::Trajectory MakeTurningDumbbell(const Dumbbell& dumbbell)
{
  return [dumbbell](double time)
  {
    const double angle = 1.5 * time;
    Dumbbell turned = dumbbell;
    turned.Direction = { std::cos(angle), 0.8 * std::sin(angle), 0.6 * std::sin(angle) };
    return MakeDumbbell(turned);
  };
}

ShapeTarget::Trajectory MakePulsatingBall(const Ball& mean, double amplitude)
{
  return [mean, amplitude](double time)
  { return MakeBall(mean.Centre, mean.Radius + amplitude * std::sin(3.0 * time)); };
}

void CheckSlope(const ShapeTarget::Trajectory& trajectory, const std::string& name)
{
  for (const double tension : { 0.0, 0.01 })
  {
    NarrowBand band(VoxelSizeOf(32));
    StartOn(band, trajectory(0.0));
    ShapeTarget target(trajectory);
    double least = 1e30;
    double largest = 0.0;
    for (int frame = 1; frame <= 200; ++frame)
    {
      band.Advance(0.05 * frame, MakeMotion(10.0, tension), target);
      const Range slopes = GetSlopes(band);
      least = std::min(least, slopes.Minimum);
      largest = std::max(largest, slopes.Maximum);
    }
    const std::string full = name + ", tension " + Number(tension);
    EXPECT_GT(least, 0.5) << "least slope in 200 frames, " << full;
    EXPECT_LT(largest, 1.5) << "largest slope in 200 frames, " << full;
  }
}

// Sample points are ill determined if the slope of the potential is far from 1.
TEST(TestTracking, SlopeStaysNearOneWhileMoving)
{
  const Point centre = { 0.01, 0.02, -0.013 };
  CheckSlope(MakeShuttlingBall({ { -0.4, 0.013, -0.007 }, 0.4 }), "shuttling ball");
  CheckSlope(MakeTurningDumbbell({ centre, {}, 0.45, 0.3, 0.15 }), "turning dumbbell");
  CheckSlope(MakePulsatingBall({ centre, 0.5 }, 0.2), "pulsating ball");
}

TEST(TestTracking, SlopeStaysNearOneWhileMovingAtRandom)
{
  RandomShapes random(15);
  const Point centre = { 0.01, 0.02, -0.013 };
  const Ball shuttle = random.DrawBallNear({ { -0.4, 0.013, -0.007 }, 0.4 });
  CheckSlope(MakeShuttlingBall(shuttle), "shuttling ball");
  const Dumbbell dumbbell = { random.DrawPointNear(centre), {}, random.DrawLengthNear(0.45),
    random.DrawLengthNear(0.3), random.DrawLengthNear(0.15) };
  CheckSlope(MakeTurningDumbbell(dumbbell), "turning dumbbell");
  const Ball mean = random.DrawBallNear({ centre, 0.5 });
  CheckSlope(MakePulsatingBall(mean, random.DrawLengthNear(0.2)), "pulsating ball");
}
}
