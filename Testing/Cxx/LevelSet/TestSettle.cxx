// The surface reaches a steady state, detects it, and then skips substeps. Includes steady states
// on the walls.

#include "Support/RandomShapes.h"
#include "Support/SurfaceMeasures.h"
#include "Support/Throws.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

using namespace activesurface;

namespace TestSettle
{
constexpr double Pi = 3.14159265358979323846;
constexpr Point Origin = { 0.0, 0.0, 0.0 };

Motion WithTension(double tension)
{
  Motion motion = MakeMotion(1.0, 0.0);
  motion.Tension = tension;
  return motion;
}

// The radius is r = (R + sqrt(R^2 - 8 b / a)) / 2, as in TestRest.
TEST(TestSettle, SettledBallHasTheExactRadius)
{
  for (const double tension : { 0.0, 0.005, 0.02 })
  {
    const double h = VoxelSizeOf(40), radius = 0.6;
    NarrowBand band(h);
    StartOn(band, MakeBall(CentreA, 0.5));
    ShapeTarget target(MakeBall(CentreA, radius));
    const AdvanceReport report =
      band.AdvanceToSteadyState(WithTension(tension), SteadyStateCriterion(), target);
    const double exact = 0.5 * (radius + std::sqrt(radius * radius - 8.0 * tension));
    const Range radii = GetRadii(Polygonise(band), CentreA);
    const std::string name = ", tension " + std::to_string(tension);
    EXPECT_TRUE(report.IsSteady) << "reported as steady" << name;
    EXPECT_LT(report.SurfaceSpeed, 1e-3) << "speed [h/time]" << name;
    EXPECT_NEAR((radii.Mean - exact) / h, 0.0, 0.04) << "error of the radius [h]" << name;
    EXPECT_LT(radii.GetSpread() / h, 0.08) << "spread of the radii [h]" << name;
  }
}

// A ball under tension is in a steady state if its volume is conserved. The displacement that
// restores the volume counts as motion.
TEST(TestSettle, HeldBallIsAtRest)
{
  NarrowBand band(VoxelSizeOf(40));
  StartOn(band, MakeEllipsoid({ 0.6, 0.5, 0.4 }));
  ShapeTarget none(MakeConstant(0.0));
  Motion motion = WithTension(1.0);
  motion.Attraction = 0.0;
  motion.VolumeControl = Control::Exact;
  // The tolerance is small compared with the speed of tension, 2 / r = 80 h.
  const AdvanceReport report = band.AdvanceToSteadyState(motion, { 1e-3, 5000 }, none);
  const double radius = std::cbrt(3.0 * band.GetVolume() / (4.0 * Pi));
  EXPECT_TRUE(report.IsSteady) << "reported as steady";
  EXPECT_LT(GetRadii(Polygonise(band), Origin).GetSpread() / radius, 0.01) << "relative spread";
}

TEST(TestSettle, SettlingEndsWithItsSubsteps)
{
  NarrowBand band(VoxelSizeOf(40));
  StartOn(band, MakeBall(Origin, 0.3));
  ShapeTarget target(MakeBall(Origin, 0.6));
  const AdvanceReport report = band.AdvanceToSteadyState(Motion(), { 1e-3, 5 }, target);
  EXPECT_FALSE(report.IsSteady) << "reported as not steady";
  EXPECT_EQ(report.Substeps, 5u) << "substeps";
  EXPECT_GT(report.SurfaceSpeed, 1e-3) << "speed [h/time]";
  EXPECT_TRUE(std::isnan(report.MovingShare)) << "no window has ended";
  const AdvanceReport none = band.AdvanceToSteadyState(Motion(), { 1e-3, 0 }, target);
  EXPECT_EQ(none.Substeps, 0u) << "substeps of none";
  EXPECT_TRUE(Throws<std::invalid_argument>(
    [&] {
      band.AdvanceToSteadyState(Motion(), { std::nan(""), 5 }, target);
    },
    "RestTolerance"))
    << "NaN";
}

TEST(TestSettle, SettlingReportsProgressAndStops)
{
  NarrowBand band(VoxelSizeOf(32));
  StartOn(band, MakeBall(Origin, 0.3));
  ShapeTarget target(MakeBall(Origin, 0.6));
  int calls = 0;
  const AdvanceReport report = band.AdvanceToSteadyState(
    Motion(), SteadyStateCriterion(), target, [&calls](double) { return ++calls <= 3; });
  EXPECT_TRUE(report.Aborted && !report.IsSteady) << "reported as aborted";
  EXPECT_EQ(report.Substeps, 3u) << "substeps";
}

// The lattice cannot represent noise of half a voxel's length. A part of the surface oscillates
// forever by more than the tolerance.
TEST(TestSettle, WhatMovesToAndFroIsNotWaitedFor)
{
  const double h = VoxelSizeOf(40);
  const Shape noisy = MakeNoisy(MakeBall(Origin, .6), .5 * h, .5 * h);
  for (const double tolerance : { 1e-3, 0.0 })
  {
    NarrowBand band(h);
    StartOn(band, MakeBall(Origin, .5));
    ShapeTarget target(noisy);
    const AdvanceReport report =
      band.AdvanceToSteadyState(MakeMotion(1.0, 0.0), { tolerance, 1000 }, target);
    EXPECT_EQ(report.IsSteady, tolerance > 0.0) << "tolerance " << tolerance;
    EXPECT_GT(report.SurfaceSpeed, 1e-3) << "it does not stand still";
    EXPECT_GT(report.MovingShare, 0.0);
    EXPECT_LE(report.MovingShare, .05);
    EXPECT_NEAR(GetRadii(Polygonise(band), Origin).Mean / h, .6 / h, .25) << "radius";
  }
}

TEST(TestSettle, SurfaceSleepsAtRestAndWakes)
{
  const Shape ring = MakeTorus({ 0.01, 0.02, 0.013 }, 0.55, 0.22);
  NarrowBand band(VoxelSizeOf(40));
  StartOn(band, MakeBall(Origin, 0.6));
  ShapeTarget target(
    [&ring](double time) {
      return time < 60.0 ? ring : MakeTorus({ 0.01, 0.02, 0.113 }, 0.55, 0.22);
    });
  band.Advance(30.0, Motion(), target);
  const auto before = band.Clone();
  const AdvanceReport asleep = band.Advance(50.0, Motion(), target);
  EXPECT_TRUE(AreIdentical(*before, band)) << "twenty units of time later: the same potential";
  EXPECT_EQ(asleep.Substeps, 0u) << "substeps asleep";
  EXPECT_GT(asleep.SkippedSubsteps, 0u) << "substeps slept";
  const AdvanceReport awake = band.Advance(80.0, Motion(), target);
  EXPECT_GT(awake.Substeps, 0) << "substeps after the target has moved";
  const Shape moved = MakeTorus({ 0.01, 0.02, 0.113 }, 0.55, 0.22);
  EXPECT_LT(GetDeviation(Polygonise(band), moved, VoxelSizeOf(40)).MeanDistance, 0.004)
    << "mean distance to where the target is now [h]";
}

// Skipped substeps increase the lag by at most a thousandth of a voxel.
TEST(TestSettle, SleepDoesNotFreezeSlowMotion)
{
  const double h = VoxelSizeOf(40), speed = 1e-3 * h; // a voxel in a thousand time constants
  NarrowBand band(h);
  StartOn(band, MakeBall(CentreA, 0.5));
  ShapeTarget target(
    [&](double time) {
      return MakeBall({ CentreA[0] + speed * time, CentreA[1], CentreA[2] }, 0.5);
    });
  double farthest = 0.0;
  for (int i = 1; i <= 20; ++i)
  {
    const double time = 100.0 * i;
    band.Advance(time, Motion(), target);
    const Shape now = MakeBall({ CentreA[0] + speed * time, CentreA[1], CentreA[2] }, 0.5);
    farthest = std::max(farthest, GetDeviation(Polygonise(band), now, h).MeanDistance);
  }
  // Sum of the bound of SurfaceArrivesAtItsTarget, a lag of speed / Attraction = 0.001 h and the
  // thousandth.
  EXPECT_LT(farthest, 0.004 + 0.001 + 0.001) << "largest mean distance of all steps [h]";
}

// The target extends through the wall. The rim at the wall is accurate to a tenth of a voxel.
TEST(TestSettle, SurfaceRestsOnTheWall)
{
  for (const int n : { 32, 64 })
  {
    const double h = VoxelSizeOf(n);
    const Shape end = MakeBall({ 0.5, 0.01, -0.02 }, 0.7);
    Motion motion = MakeMotion(1.0, 0.0);
    motion.Box = { true, { -0.93, 0.93, -0.93, 0.93, -0.93, 0.93 } };
    NarrowBand band(h);
    StartOn(band, MakeBall(Origin, 0.5));
    ShapeTarget target(end);
    band.Advance(12.0, motion, target);
    const Mesh mesh = Polygonise(band);
    double largest = 0.0, farthest = 0.0;
    for (std::size_t i = 0; i < mesh.GetNumberOfPoints(); ++i)
    {
      const Point point = mesh.GetPoint(i);
      largest = std::max(largest, std::fabs(std::max(end.Value(point), point[0] - 0.93)));
      farthest = std::max(farthest, point[0]);
    }
    const std::string name = ", n = " + std::to_string(n);
    EXPECT_LT(largest / h, 0.1) << "largest distance to the target within the wall [h]" << name;
    EXPECT_LT(farthest, 0.93 + 1e-6) << "farthest point" << name;
    EXPECT_LT(0.93 - 0.01 * h, farthest) << "it lies on the wall" << name;
    EXPECT_EQ(FindDefects(mesh).Edges, 0u) << "defects" << name;
  }
}

TEST(TestSettle, NothingCrossesTheWall)
{
  for (const Control control : { Control::Penalty, Control::Exact })
  {
    NarrowBand band(VoxelSizeOf(32));
    Motion motion = WithTension(0.01);
    motion.Attraction = 0.0;
    motion.VolumeControl = control;
    motion.VolumeStiffness = 5.0;
    motion.TargetVolume = 3.0; // the bounds hold 1.728
    motion.Box = { true, { -0.6, 0.6, -0.6, 0.6, -0.6, 0.6 } };
    StartOn(band, MakeBall(CentreA, 0.4));
    ShapeTarget none(MakeConstant(0.0));
    band.Advance(0.5, motion, none);
    const Mesh mesh = Polygonise(band);
    double farthest = 0.0;
    for (const float coordinate : mesh.Points)
    {
      farthest = std::max(farthest, std::fabs(double(coordinate)));
    }
    EXPECT_LT(farthest, 0.6 + 1e-6) << "largest coordinate";
    EXPECT_GT(band.GetVolume(), 1.6) << "volume that fills the box";
  }
}
}
