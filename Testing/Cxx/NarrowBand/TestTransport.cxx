// Transport: the surface is carried by the target's own velocity, so that it does not lag behind.

#include "Support/RandomShapes.h"
#include "Support/SurfaceMeasures.h"
#include "Support/Throws.h"

#include "NarrowBandGrid.h"
#include "Substep/WalledTarget.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>

using namespace activesurface;

namespace TestTransport
{
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
const double H = VoxelSizeOf(64);

// 22 voxels in the time Journey.
constexpr double Journey = 0.76;
constexpr RigidMotion Straight = { { -0.4, -0.2, -0.1 }, { 0.8, 0.4, 0.2 }, { 0.0, 0.0, 1.0 },
  0.0 };
// The same way, and 1.5 radians about an axis oblique to the lattice.
constexpr RigidMotion Turning = { Straight.Start, Straight.Velocity,
  { 1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0 }, 2.0 };

struct Body
{
  std::string Name;
  Shape Form; //< about the origin
  RigidMotion Way;
  double MostLag; //< [h]
};

const Body Ball = { "ball", MakeBall({ 0.0, 0.0, 0.0 }, 0.3), Straight, 0.05 };
const Body Bodies[] = { Ball, { "ellipsoid", MakeEllipsoid({ 0.36, 0.3, 0.26 }), Straight, 0.15 },
  { "turning ellipsoid", MakeEllipsoid({ 0.36, 0.3, 0.26 }), Turning, 0.05 } };

ShapeTarget FollowBody(const Body& body)
{
  return ShapeTarget([body](double time) { return Carry(body.Form, body.Way, time); });
}

Motion MakeCarried(double attraction, double transport)
{
  Motion motion = MakeMotion(attraction, 0.0);
  motion.Transport = transport;
  return motion;
}

/** Where the surface is, relative to the body at the end. */
struct Arrival
{
  double Lag;   //< distance by which it is behind, as a whole [h]
  double Swell; //< mean distance outside the body [h]
  Deviation From;
};

Arrival Arrive(const Body& body, const Motion& motion)
{
  NarrowBand band(H);
  StartOn(band, Carry(body.Form, body.Way, 0.0));
  ShapeTarget target = FollowBody(body);
  band.Advance(Journey, motion, target);
  const Shape end = Carry(body.Form, body.Way, Journey);
  const Mesh mesh = Polygonise(band);
  const Point& way = body.Way.Velocity;
  const double speed = std::hypot(way[0], way[1], way[2]);
  double behind = 0.0, squares = 0.0, outside = 0.0;
  for (std::size_t i = 0; i < mesh.GetNumberOfPoints(); ++i)
  {
    // Least squares: a body that is behind by s is off by -s times the normal's part along the way.
    const Point point = mesh.GetPoint(i), normal = mesh.GetNormal(i);
    const double distance = end.Value(point) / end.Slope(point) / H;
    const double along = (normal[0] * way[0] + normal[1] * way[1] + normal[2] * way[2]) / speed;
    behind -= distance * along;
    squares += along * along;
    outside += distance;
  }
  return { behind / squares, outside / static_cast<double>(mesh.GetNumberOfPoints()),
    GetDeviation(mesh, end, H) };
}

// .05 h, where without Transport it is the speed over Attraction, 1.4 h at 20. An ellipsoid that
// goes straight on keeps its tips in front and behind, six voxels in radius, where the error of a
// uniform speed (TestTracking: .15 h) adds up.
TEST(TestTransport, NothingLagsAtAnyAttraction)
{
  for (const Body& body : Bodies)
  {
    for (const double attraction : { 0.0, 1.0, 20.0 })
    {
      const Arrival arrival = Arrive(body, MakeCarried(attraction, 1.0));
      const std::string name = body.Name + ", Attraction " + std::to_string(attraction);
      EXPECT_NEAR(arrival.Lag, 0.0, body.MostLag) << "lag [h], " << name;
      // As of a surface that moves at a uniform speed (TestTracking): its mean and its spread.
      EXPECT_NEAR(arrival.Swell, 0.0, 0.15) << "mean distance outside [h], " << name;
      EXPECT_LT(arrival.From.LargestDistance, 0.15 + 0.25) << "farthest from it [h], " << name;
    }
  }
}

// Of the lag U / Attraction (1 - e^(-Attraction t)) the share 1 - Transport is left. .1 h: an Euler
// substep of h / 2.6 is behind an exponential by up to dt / 2 of its speed, .19 h e^-1.
TEST(TestTransport, TheRestOfTheLagIsLeft)
{
  for (const double transport : { 0.0, 0.5 })
  {
    const double attraction = 10.0;
    const double whole = 0.9165 / attraction * (1.0 - std::exp(-attraction * Journey)) / H;
    const Arrival arrival = Arrive(Ball, MakeCarried(attraction, transport));
    EXPECT_NEAR(arrival.Lag, (1.0 - transport) * whole, 0.1) << "lag [h], Transport " << transport;
  }
}

// A turning ball is where it was. Its velocity, along the surface, limits the substep none the
// less: a wave of the surface is carried along with it.
TEST(TestTransport, ABallThatSpinsStaysWhatItIs)
{
  Body ball = Ball;
  ball.Way = { CentreA, {}, Turning.Axis, 6.0 };
  NarrowBand band(H);
  StartOn(band, Carry(ball.Form, ball.Way, 0.0));
  ShapeTarget target = FollowBody(ball);
  const AdvanceReport report = band.Advance(1.0, MakeCarried(0.0, 1.0), target);
  // 2.6 * 6 * .3 / h a time, less a tenth as no crossing is at the equator.
  EXPECT_GT(report.Substeps, 0.9 * 2.598 * 1.8 / H) << "substeps of h / 2.6 at most";
  // As of a surface that moves at a uniform speed (TestTracking); the equator goes 57 voxels.
  const Range radii = GetRadii(Polygonise(band), CentreA);
  EXPECT_NEAR((radii.Mean - 0.3) / H, 0.0, 0.15) << "mean radius [h]";
  EXPECT_LT(radii.GetSpread() / H, 0.25) << "spread of the radii [h]";
}

std::unique_ptr<NarrowBand> RunWith(
  const Body& body, const Motion& motion, const std::function<Point(const Point&)>& velocity)
{
  auto band = std::make_unique<NarrowBand>(H);
  StartOn(*band, Carry(body.Form, body.Way, 0.0));
  ShapeTarget target(
    [&](double time)
    {
      Shape shape = Carry(body.Form, body.Way, time);
      shape.Velocity = velocity;
      return shape;
    });
  band->Advance(0.2, motion, target);
  return band;
}

TEST(TestTransport, AVelocityThatIsNotFiniteCountsAsNone)
{
  const Motion motion = MakeCarried(5.0, 1.0);
  const auto none = RunWith(Ball, motion, [](const Point&) { return Point{}; });
  for (const double wrong : { NaN, std::numeric_limits<double>::infinity() })
  {
    const auto band = RunWith(Ball, motion,
      [wrong](const Point&) {
        return Point{ 0.1, wrong, 0 };
      });
    EXPECT_TRUE(AreIdentical(*none, *band)) << "the same potential, velocity " << wrong;
  }
  const auto moving = RunWith(Ball, motion, [](const Point&) { return Point{ 0.1, 0.0, 0.0 }; });
  EXPECT_FALSE(AreIdentical(*none, *moving)) << "a velocity makes a difference";
}

// On its target, which goes on: no leaf in which it does has converged, but those of a ball that
// stays have.
TEST(TestTransport, WhatIsCarriedHasNotConverged)
{
  NarrowBand band(H);
  const Shape ball = MakeBall(CentreA, 0.3);
  StartOn(band, ball);
  Shape moving = ball;
  moving.Velocity = [](const Point&) { return Point{ 0.1, 0.0, 0.0 }; };
  ShapeTarget still(ball), target(moving);
  const Motion motion = MakeCarried(20.0, 1.0);
  band.Advance(1.0, motion, still);
  EXPECT_EQ(band.Advance(2.0, motion, still).Substeps, 0u) << "substeps of the one that stays";
  const AdvanceReport report = band.Advance(2.01, motion, target);
  EXPECT_GT(report.Substeps, 0u) << "substeps of the one that goes on";
  EXPECT_EQ(report.SkippedSubsteps, 0u) << "of which none is skipped";
  EXPECT_NEAR(report.MaxSpeed, 0.1, 0.01) << "largest speed";
}

// Velocities that meet and part within a voxel or two, as of drops that the lattice cannot hold
// apart: where they meet, u gets steeper by a factor in each explicit substep, beyond all bounds.
TEST(TestTransport, VelocitiesThatMeetEndInNoError)
{
  const Shape zero{ [](const Point&) { return 0.0; }, {}, {} };
  const Shape ball = MakeBall(CentreA, 0.3);
  for (const double cell : { 1.4, 1.5, 1.8 })
  {
    const Shape x = MakeNoisy(zero, cell * H, 6.0), y = MakeNoisy(zero, 1.2 * cell * H, 6.0);
    ShapeTarget target(
      [&](double time)
      {
        Shape shape = ball;
        const double jump = std::floor(10.0 * time); // to other velocities, eight times
        shape.Velocity = [&, jump](const Point& at)
        {
          const Point from = { at[0] + jump, at[1], at[2] };
          return Point{ x.Value(from), y.Value(from), 0.0 };
        };
        return shape;
      });
    NarrowBand band(H);
    StartOn(band, ball);
    for (int i = 1; i <= 8; ++i)
    {
      band.Advance(0.1 * i, MakeCarried(0.0, 1.0), target);
    }
    float largest = 0.f;
    for (auto node = GetPotential(band)->cbeginValueOn(); node; ++node)
    {
      largest = std::max(largest, std::fabs(*node));
    }
    EXPECT_LE(largest, 128.f) << "of the potential [h], noise of " << cell << " h";
  }
}

// The wall stands still, whatever goes through it.
TEST(TestTransport, AWallHasNoVelocity)
{
  const Walls box = { true, { -0.5, 0.5, -0.5, 0.5, -0.5, 0.5 } };
  Shape ball = MakeBall({ 0.0, 0.0, 0.0 }, 0.4);
  ball.Velocity = [](const Point&) { return Point{ 1.0, 2.0, 3.0 }; };
  ShapeTarget target(ball);
  const WalledTarget walled(target, box);
  // The ball is .3 away from the first point, the wall .2; the second one is .1 from the ball.
  const double points[6] = { 0.7, 0.0, 0.0, 0.3, 0.0, 0.0 };
  double values[2], slopes[2], velocities[6];
  walled.Evaluate(2, points, { values, slopes, velocities });
  EXPECT_NEAR(values[0], 0.3, 1e-12) << "the ball is farther than the wall";
  EXPECT_EQ(velocities[0], 1.0) << "velocity of the ball";
  EXPECT_NEAR(values[1], -0.1, 1e-12) << "distance to the ball, where that to the wall is -.2";
  EXPECT_EQ(velocities[5], 3.0) << "velocity of the ball";
  const double corner[3] = { 0.49, 0.0, 0.0 };
  ShapeTarget large(Shape{ [](const Point&) { return -1.0; }, {}, ball.Velocity });
  WalledTarget(large, box).Evaluate(1, corner, { values, slopes, velocities });
  EXPECT_NEAR(values[0], -0.01, 1e-12) << "distance to the wall, which cuts the target off";
  EXPECT_EQ(velocities[0], 0.0) << "velocity of the wall";
  EXPECT_EQ(velocities[2], 0.0) << "velocity of the wall";
}

TEST(TestTransport, WrongSharesAreRefused)
{
  NarrowBand band(H);
  StartOn(band, MakeBall(CentreA, 0.3));
  ShapeTarget target(MakeBall(CentreA, 0.3));
  for (const double transport : { -0.1, 1.1, NaN })
  {
    EXPECT_TRUE(Throws<std::invalid_argument>(
      [&] { band.Advance(1.0, MakeCarried(1.0, transport), target); }, "Transport must be"))
      << transport;
  }
  Motion paper = MakeCarried(1.0, 1.0);
  paper.Paper = true;
  EXPECT_TRUE(Throws<std::invalid_argument>(
    [&] { band.Advance(1.0, paper, target); }, "neither Transport nor WeightedTension"));
}
}
