// What is said of the implicit integration alone; the exact tests run with it too, as
// Implicit/TestX.

#include "NarrowBandGrid.h"
#include "Support/AnalyticShapes.h"
#include "Support/RandomShapes.h"
#include "Support/SurfaceMeasures.h"
#include "Support/Throws.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

using namespace activesurface;

namespace TestImplicit
{
const double H = VoxelSizeOf(64);

// A uniform speed of a target out of reach, twelve voxels in one substep: no clamp is a speed
// limit. Tolerances of TestTracking.
TEST(TestImplicit, OneSubstepGoesAsFarAsTheTargetSays)
{
  for (const double way : { .4, -.4 })
  {
    NarrowBand band(H);
    StartOn(band, MakeBall(CentreA, .5 - .5 * way));
    ShapeTarget target(MakeConstant(-way));
    const AdvanceReport report = band.Advance(1.0, MakeImplicit(1.0, 0.0), target);
    const Range radii = GetRadii(Polygonise(band), CentreA);
    EXPECT_EQ(report.Substeps, 1u) << "substeps";
    EXPECT_NEAR((radii.Mean - .5 - .5 * way) / H, 0.0, .15) << "error of the mean radius [h]";
    EXPECT_LT(radii.GetSpread() / H, .25) << "spread of the radii [h]";
  }
}

// The radius of a ball under attraction and tension, r' = -(r - R) - 2 Tension / r, by small steps.
double FindRadius(double from, double to, double tension, double time)
{
  const int steps = 100000;
  double radius = from;
  for (int i = 0; i < steps; ++i)
  {
    const auto rate = [&](double r) { return to - r - 2.0 * tension / r; };
    const double middle = radius + .5 * time / steps * rate(radius);
    radius += time / steps * rate(middle);
  }
  return radius;
}

// As exact as an approach without tension (TestTracking: .2 h at n = 64), with any length of step.
TEST(TestImplicit, ABallUnderAttractionAndTensionIsOnTime)
{
  const double exact = FindRadius(.3, .6, .01, 1.0);
  const auto error = [&](double cfl)
  {
    NarrowBand band(H);
    StartOn(band, MakeBall(CentreA, .3));
    ShapeTarget target(MakeBall(CentreA, .6));
    Motion motion = MakeImplicit(1.0, .01);
    motion.CFL = cfl;
    band.Advance(1.0, motion, target);
    return std::fabs(GetRadii(Polygonise(band), CentreA).Mean - exact) / H;
  };
  for (const double cfl : { 1.0, .5, .25 })
  {
    EXPECT_LT(error(cfl), .2) << "error of the radius [h], CFL " << cfl;
  }
}

// From a ball to two: an explicit scheme makes six times as many substeps.
TEST(TestImplicit, SubstepsAreFew)
{
  const Shape two = MakeBalls({ { { -.43, .01, .02 }, .3 }, { { .45, .03, -.01 }, .33 } });
  std::size_t substeps[2];
  for (const bool isImplicit : { false, true })
  {
    NarrowBand band(H);
    StartOn(band, MakeBall(CentreA, .5));
    ShapeTarget target(two);
    Motion motion = MakeImplicit(1.0, 0.0);
    motion.Integration = isImplicit ? TimeIntegration::Implicit : TimeIntegration::Explicit;
    substeps[isImplicit] = band.Advance(8.0, motion, target).Substeps;
    EXPECT_EQ(GetTopology(Polygonise(band)).Components, 2) << "balls";
  }
  EXPECT_LT(6 * substeps[1], substeps[0]) << "substeps: " << substeps[1] << ", " << substeps[0];
}

// The explicit scheme stays as rough as the noise makes it; so does this one, with no tension or
// with one that smooths a seventh of a voxel.
TEST(TestImplicit, NoiseMakesASurfaceRoughButNoRougherInTime)
{
  const double h = VoxelSizeOf(20);
  for (const double tension : { 0.0, .02 * h * h })
  {
    NarrowBand band(h);
    StartOn(band, MakeBall({ 0.0, 0.0, 0.0 }, .6));
    ShapeTarget target(MakeNoisy(MakeBall({ 0.0, 0.0, 0.0 }, .6), .5 * h, 1.5 * h));
    band.Advance(60.0, MakeImplicit(1.0, tension), target);
    const double before = band.GetArea();
    const Topology early = GetTopology(Polygonise(band));
    band.Advance(1000.0, MakeImplicit(1.0, tension), target);
    EXPECT_NEAR(band.GetArea() / before, 1.0, .02) << "area, tension " << tension;
    EXPECT_LE(GetTopology(Polygonise(band)).Components, early.Components + 2);
  }
}

/** Two balls: what is beyond x = 0 has the velocity, the rest has none. */
ShapeTarget FollowOneOfTwo(const Point& velocity)
{
  return ShapeTarget(
    [velocity](double time)
    {
      const Point centre = { .3 + time * velocity[0], time * velocity[1], time * velocity[2] };
      Shape shape = MakeBalls({ { { -.5, 0.0, 0.0 }, .2 }, { centre, .2 } });
      shape.Velocity = [velocity, centre](const Point& point)
      {
        const double far = std::numeric_limits<double>::quiet_NaN();
        const double distance =
          std::hypot(point[0] - centre[0], point[1] - centre[1], point[2] - centre[2]);
        return distance < .35 ? velocity : Point{ far, far, far };
      };
      return shape;
    });
}

// Sixteen voxels in one step, more than the ball's diameter: it arrives whole, nothing is left
// behind, and the other one keeps its bytes. The cubic of a ball of six voxels is right to .02 h.
TEST(TestImplicit, TransportTakesAPartAwayAndLeavesTheOther)
{
  const Point velocity = { .1, .35, -.35 };
  NarrowBand band(H);
  ShapeTarget target = FollowOneOfTwo(velocity);
  StartOn(band, MakeBalls({ { { -.5, 0.0, 0.0 }, .2 }, { { .3, 0.0, 0.0 }, .2 } }));
  const double volume = band.GetVolume();
  const auto before = band.Clone();
  Motion motion = MakeImplicit(0.0, 0.0);
  motion.Transport = 1.0;
  band.Advance(1.0, motion, target);
  const Mesh mesh = Polygonise(band);
  EXPECT_EQ(GetTopology(mesh).Components, 2) << "balls";
  EXPECT_NEAR(band.GetVolume() / volume, 1.0, .01) << "volume";
  double farthest = 0.0;
  for (std::size_t i = 0; i < mesh.GetNumberOfPoints(); ++i)
  {
    const Point p = mesh.GetPoint(i);
    if (p[0] > 0.0)
    {
      const double r = std::hypot(p[0] - .4, p[1] - .35, p[2] + .35);
      farthest = std::max(farthest, std::fabs(r - .2) / H);
    }
  }
  EXPECT_LT(farthest, .1) << "largest distance of the ball that moved [h]";
  const openvdb::Coord inside(-20, 0, 0);
  EXPECT_EQ(
    GetPotential(band)->tree().getValue(inside), GetPotential(*before)->tree().getValue(inside))
    << "u of the ball that stays";
}

// Without Attraction or weights the target is not sampled; a carried ball shrinks by tension alone,
// r^2 = r0^2 - 4 Tension t, to .35 % as at rest on its place (TestTension).
TEST(TestImplicit, WhatIsCarriedFeelsTension)
{
  NarrowBand band(H);
  StartOn(band, MakeBall({ -.2, 0.0, 0.0 }, .4));
  ShapeTarget target(
    [](double time)
    {
      Shape shape = MakeBall({ -.2 + .4 * time, 0.0, 0.0 }, .4);
      shape.Velocity = [](const Point&) { return Point{ .4, 0.0, 0.0 }; };
      return shape;
    });
  Motion motion = MakeImplicit(0.0, .01);
  motion.Transport = 1.0;
  band.Advance(1.0, motion, target);
  const double radius = std::sqrt(.16 - .04);
  EXPECT_NEAR(GetRadii(Polygonise(band), { .2, 0.0, 0.0 }).Mean / radius, 1.0, .0035) << "radius";
}

// A = 8 takes four substeps of decay 2. A target that keeps its shape needs one; so does one that
// is an eighth of a voxel larger at the end. Of two voxels two substeps leave exp(-4), .04, which
// the third one goes with all that is left; exp(-8) remains.
TEST(TestImplicit, OneCarryIsFollowedByAsManyRoundsAsTheWaysNeed)
{
  for (const auto& [growth, rounds] : { std::pair(0.0, 1), std::pair(.125, 1), std::pair(2.0, 3) })
  {
    NarrowBand band(H);
    StartOn(band, MakeBall({ -.25, 0.0, 0.0 }, .3));
    ShapeTarget target(
      [growth = growth](double time)
      {
        Shape shape = MakeBall({ -.25 + .5 * time, 0.0, 0.0 }, .3 + growth * H * time);
        shape.Velocity = [](const Point&) { return Point{ .5, 0.0, 0.0 }; };
        return shape;
      });
    Motion motion = MakeImplicit(8.0, 0.0);
    motion.Transport = 1.0;
    const AdvanceReport report = band.Advance(1.0, motion, target);
    EXPECT_EQ(report.Substeps, rounds) << "growth " << growth;
    const auto radii = GetRadii(Polygonise(band), { .25, 0.0, 0.0 });
    EXPECT_NEAR((radii.Mean - .3) / H - growth, 0.0, .03) << "growth " << growth;
    EXPECT_LT(radii.GetSpread() / H, .1) << "growth " << growth;
  }
}

TEST(TestImplicit, NothingIsCarriedThroughAWall)
{
  NarrowBand band(H);
  StartOn(band, MakeBall({ .3, 0.0, 0.0 }, .2));
  ShapeTarget target(
    [](double time)
    {
      Shape shape = MakeBall({ .3 + .3 * time, 0.0, 0.0 }, .2);
      shape.Velocity = [](const Point&) { return Point{ .3, 0.0, 0.0 }; };
      return shape;
    });
  Motion motion = MakeImplicit(0.0, 0.0);
  motion.Transport = 1.0;
  motion.Box = { true, { -.6, .6, -.6, .6, -.6, .6 } };
  band.Advance(1.0, motion, target);
  double farthest = -1.0;
  const Mesh mesh = Polygonise(band);
  for (std::size_t i = 0; i < mesh.GetNumberOfPoints(); ++i)
  {
    farthest = std::max(farthest, mesh.GetPoint(i)[0]);
  }
  EXPECT_LT(farthest, .6 + 1e-6) << "largest x";
  EXPECT_GT(farthest, .6 - .1 * H) << "largest x, at the wall";
}

// As by explicit substeps: more than a million of them, or too short ones, are not begun.
TEST(TestImplicit, AbsurdRatesAreRefused)
{
  NarrowBand band(H);
  StartOn(band, MakeBall(CentreA, .3));
  Shape moving = MakeBall(CentreA, .3);
  moving.Velocity = [](const Point&) { return Point{ .4, 0.0, 0.0 }; };
  ShapeTarget target(moving);
  for (const double rate : { 1e10, 1e30, 1e308 })
  {
    Motion carried = MakeImplicit(rate, 0.0), pressed = MakeImplicit(1.0, .01);
    carried.Transport = 1.0;
    pressed.VolumeControl = Control::Penalty;
    pressed.VolumeStiffness = rate;
    for (const Motion& motion : { MakeImplicit(rate, 0.0), MakeImplicit(rate, .01),
           MakeImplicit(1.0, rate), carried, pressed })
    {
      EXPECT_TRUE(Throws<std::runtime_error>(
        [&] { band.Advance(1.0, motion, target); }, "The stable time step is"))
        << "rate " << rate;
    }
  }
}

TEST(TestImplicit, WhatDoesNotGoWithItIsRefused)
{
  NarrowBand band(H);
  StartOn(band, MakeBall(CentreA, .3));
  ShapeTarget target(MakeBall(CentreA, .3));
  Motion paper = MakeImplicit(1.0, 0.0), node = paper, central = paper;
  paper.Paper = true;
  node.Evaluation = TargetEvaluation::Node;
  central.Gradient = GradientScheme::Central;
  for (const Motion& motion : { paper, node, central })
  {
    EXPECT_TRUE(Throws<std::invalid_argument>(
      [&] { band.Advance(1.0, motion, target); }, "set TimeIntegration to EXPLICIT"));
  }
  EXPECT_TRUE(Throws<std::invalid_argument>(
    [&] { band.Advance(1.0, MakeImplicit(1.0, -1.0), target); }, "Tension >= 0"));
}
}
