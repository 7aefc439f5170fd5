// Area and volume are constrained exactly, or by a penalty with the offset that theory predicts.

#include "Support/SurfaceMeasures.h"
#include "Support/Throws.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

using namespace activesurface;

namespace TestControls
{
constexpr double Pi = 3.14159265358979323846;

Motion TensionWith(Control area, Control volume, double stiffness = 1.0)
{
  Motion motion = MakeMotion(1.0, 0.0);
  motion.Attraction = 0.0;
  motion.Tension = 1.0;
  motion.AreaControl = area;
  motion.VolumeControl = volume;
  motion.AreaStiffness = motion.VolumeStiffness = stiffness;
  return motion;
}

// Advances one substep of any length.
void StepOnce(NarrowBand& band, const Motion& motion, Target& target)
{
  bool first = true;
  band.Advance(band.GetTime() + 10.0, motion, target,
    [&first](double) { return std::exchange(first, false); });
}

// Relative deficit e that a penalty leaves: the smaller solution of e (1 - e)^power = force.
double OffsetOf(double power, double force)
{
  double low = 0.0, high = 1.0 / (1.0 + power); // where the left side is largest
  for (int i = 0; i < 60; ++i)
  {
    const double middle = 0.5 * (low + high);
    (middle * std::pow(1.0 - middle, power) < force ? low : high) = middle;
  }
  return low;
}

struct Held
{
  Point Centre;
  double Radius;
  double Stiffness;
};

// A ball is in a steady state where the speed 2 b / r of the tension b equals the speed of the
// penalty. The curvature has a bias of 0.3 % at a radius of 7 voxels, hence the tolerance of 1 %.
TEST(TestControls, PenaltyOfVolumeLeavesTheExactOffset)
{
  for (const Held& held :
    { Held{ CentreA, 0.5, 100.0 }, Held{ CentreA, 0.5, 1000.0 }, Held{ CentreB, 0.45, 150.0 } })
  {
    NarrowBand band(VoxelSizeOf(32));
    StartOn(band, MakeBall(held.Centre, held.Radius));
    ShapeTarget none(MakeConstant(0.0));
    const double start = band.GetVolume();
    band.Advance(0.08, TensionWith(Control::None, Control::Penalty, held.Stiffness), none);
    const double radius = std::cbrt(3.0 * start / (4.0 * Pi));
    const double exact = OffsetOf(1.0 / 3.0, 2.0 / (held.Stiffness * radius));
    EXPECT_NEAR((1.0 - band.GetVolume() / start) / exact, 1.0, 0.01)
      << "missing volume over the exact one, stiffness " << held.Stiffness;
  }
}

TEST(TestControls, PenaltyOfAreaLeavesTheExactOffset)
{
  for (const Held& held : { Held{ CentreA, 0.5, 100.0 }, Held{ CentreB, 0.45, 400.0 } })
  {
    NarrowBand band(VoxelSizeOf(32));
    StartOn(band, MakeBall(held.Centre, held.Radius));
    ShapeTarget none(MakeConstant(0.0));
    const double start = band.GetArea();
    band.Advance(0.08, TensionWith(Control::Penalty, Control::None, held.Stiffness), none);
    const double radius = std::sqrt(start / (4.0 * Pi));
    const double exact = OffsetOf(0.5, 2.0 / (held.Stiffness * radius));
    EXPECT_NEAR((1.0 - band.GetArea() / start) / exact, 1.0, 0.01)
      << "missing area over the exact one, stiffness " << held.Stiffness;
  }
}

// No steady state exists below stiffness * r0 = 4.233 b for the volume.
TEST(TestControls, WeakPenaltyDoesNotHoldABall)
{
  const double radius = 0.5;
  for (const auto& [force, survives] : { std::pair(3.9, false), std::pair(4.6, true) })
  {
    NarrowBand band(VoxelSizeOf(32));
    StartOn(band, MakeBall(CentreA, radius));
    ShapeTarget none(MakeConstant(0.0));
    band.Advance(1.0, TensionWith(Control::None, Control::Penalty, force / radius), none);
    EXPECT_TRUE(band.IsEmpty() != survives) << "the ball's fate at " << force;
  }
}

struct Journey
{
  const char* Name;
  Shape Start;
  Shape End; //< target, if Attraction is not 0
  Motion Way;
  double Time;
  Topology Expected; //< at one time of the motion at least
  double Tolerance;
};

bool operator==(const Topology& a, const Topology& b)
{
  return a.Components == b.Components && a.Voids == b.Voids &&
    a.EulerCharacteristic == b.EulerCharacteristic;
}

// Checks the measure after every substep.
void CheckHeld(const Journey& journey, int n, double (NarrowBand::*measure)() const)
{
  NarrowBand band(VoxelSizeOf(n));
  StartOn(band, journey.Start);
  ShapeTarget target(journey.End);
  const double start = (band.*measure)();
  double largest = 0.0;
  int substeps = 0;
  bool expectedSeen = false;
  for (; band.GetTime() < journey.Time && substeps < 3000; ++substeps)
  {
    StepOnce(band, journey.Way, target);
    largest = std::max(largest, std::fabs((band.*measure)() / start - 1.0));
    expectedSeen = expectedSeen || GetTopology(Polygonise(band)) == journey.Expected;
  }
  const std::string name = std::string(journey.Name) + ", n = " + std::to_string(n);
  EXPECT_GT(substeps, 10.0) << "substeps, " << name;
  EXPECT_LT(largest, journey.Tolerance) << "largest relative error of all steps, " << name;
  EXPECT_TRUE(expectedSeen) << "the expected bodies at some step, " << name;
}

Motion ExactWay(double attraction, double tension)
{
  Motion motion = TensionWith(Control::None, Control::Exact);
  motion.Attraction = attraction;
  motion.Tension = tension;
  return motion;
}

// In the course that splits, crossings appear and vanish, so its tolerance is 1e-5 instead of 1e-6.
TEST(TestControls, ExactVolumeIsHeld)
{
  const Point origin = { 0.0, 0.0, 0.0 };
  const Shape none = MakeConstant(0.0);
  const Shape two = MakeBalls({ { { -0.43, 0.01, 0.02 }, 0.3 }, { { 0.45, 0.03, -0.01 }, 0.33 } });
  for (const Journey& journey : { Journey{ "ellipsoid", MakeEllipsoid({ 0.7, 0.4, 0.3 }), none,
                                    ExactWay(0.0, 1.0), 0.1, { 1, 0, 2 }, 1e-6 },
         Journey{ "one ball to two", MakeBall(origin, 0.5), two, ExactWay(1.0, 0.0), 8.0,
           { 2, 0, 4 }, 1e-5 },
         Journey{ "ball to six metaballs", MakeBall(origin, 0.5), MakeSixMetaballs(),
           ExactWay(1.0, 0.02), 3.0, { 1, 0, 2 }, 1e-6 } })
  {
    CheckHeld(journey, 40, &NarrowBand::GetVolume);
  }
}

// The neck has a radius of two or three voxels. Tension tears the neck, and both drops together
// keep the volume.
TEST(TestControls, PeanutPinchesIntoTwoDropsOfItsVolume)
{
  const Shape peanut = MakeDumbbell({ CentreA, { 1.0, 0.0, 0.0 }, 0.5, 0.3, 0.1 });
  for (const int n : { 40, 64 })
  {
    CheckHeld({ "peanut", peanut, MakeConstant(0.0), ExactWay(0.0, 1.0), 0.04, { 2, 0, 4 }, 1e-5 },
      n, &NarrowBand::GetVolume);
  }
}

TEST(TestControls, ExactAreaIsHeld)
{
  const Journey journey = { "ellipsoid", MakeEllipsoid({ 0.7, 0.4, 0.3 }), MakeConstant(0.0),
    TensionWith(Control::Exact, Control::None), 0.1, { 1, 0, 2 }, 1e-6 };
  CheckHeld(journey, 40, &NarrowBand::GetArea);
}

// The ball has the largest V / A^(3/2) of all bodies. The reference ball is polygonised too, with
// the same error of polygons.
TEST(TestControls, HeldAreaGrowsToTheBallOfThatArea)
{
  NarrowBand band(VoxelSizeOf(40));
  StartOn(band, MakeEllipsoid({ 0.7, 0.4, 0.3 }));
  ShapeTarget none(MakeConstant(0.0));
  band.Advance(0.3, TensionWith(Control::Exact, Control::None), none);
  const Range radii = GetRadii(Polygonise(band), { 0.0, 0.0, 0.0 });
  NarrowBand ball(VoxelSizeOf(40));
  StartOn(ball, MakeBall({ 0.0, 0.0, 0.0 }, radii.Mean));
  EXPECT_LT(radii.GetSpread() / VoxelSizeOf(40), 0.04) << "spread of the radii [h]";
  const double roundness = band.GetVolume() / std::pow(band.GetArea(), 1.5);
  EXPECT_NEAR(roundness / (ball.GetVolume() / std::pow(ball.GetArea(), 1.5)), 1.0, 1e-3)
    << "V / A^(3/2) over that of the ball";
}

TEST(TestControls, OtherVolumeThanAtTheStartCanBeHeld)
{
  NarrowBand band(VoxelSizeOf(40));
  StartOn(band, MakeBall(CentreA, 0.4));
  ShapeTarget none(MakeConstant(0.0));
  Motion motion = TensionWith(Control::None, Control::Exact);
  const double radius = 0.6;
  motion.TargetVolume = 4.0 / 3.0 * Pi * radius * radius * radius;
  band.Advance(0.01, motion, none);
  EXPECT_NEAR(band.GetVolume() / motion.TargetVolume, 1.0, 1e-6) << "volume over TargetVolume";
  // The polygons lie within the ball through their corners, by about h^2 / 6 r = 0.014 h.
  EXPECT_NEAR(GetRadii(Polygonise(band), CentreA).Mean / radius, 1.0, 0.002)
    << "radius over the exact one";
}

TEST(TestControls, WhatCannotBeHeldIsRefused)
{
  NarrowBand band(VoxelSizeOf(32));
  StartOn(band, MakeBall(CentreA, 0.5));
  ShapeTarget none(MakeConstant(0.0));
  const auto refused = [&](const Motion& motion, const char* words, const std::string& what)
  {
    EXPECT_TRUE(Throws<std::invalid_argument>(
      [&] { band.Advance(band.GetTime() + 0.01, motion, none); }, words))
      << what;
  };
  refused(TensionWith(Control::Exact, Control::Exact), "cannot both be EXACT", "both exact");
  for (const double bad : { -1.0, std::nan(""), std::numeric_limits<double>::infinity() })
  {
    Motion motion = TensionWith(Control::Penalty, Control::Penalty);
    motion.AreaStiffness = bad;
    refused(motion, "AreaStiffness and VolumeStiffness must be", "stiffness");
    motion = TensionWith(Control::Exact, Control::None);
    motion.TargetArea = bad;
    refused(motion, "TargetArea and TargetVolume must be", "area");
  }
  EXPECT_EQ(band.GetTime(), 0.0) << "the time stays";
}
}
