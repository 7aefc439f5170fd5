// Steady states of the surface: on its target, between target and tension, or vanished.

#include "Support/RandomShapes.h"
#include "Support/SurfaceMeasures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

using namespace activesurface;

namespace TestRest
{
constexpr double Pi = 3.14159265358979323846;
constexpr Point Origin = { 0.0, 0.0, 0.0 };

void Settle(NarrowBand& band, Target& target, int substeps)
{
  int asked = 0;
  const ProgressFunction mayGoOn = [&](double) { return asked++ < substeps; };
  band.Advance(10.0 * substeps, MakeMotion(1.0, 0.0), target, mayGoOn);
}

std::string Number(double value)
{
  return std::to_string(value).substr(0, 5);
}

struct Balance
{
  int Nodes;
  double Attraction;
  double Tension;
  double TargetRadius;
  Point Centre;
};

// The balance a (R - r) = 2 b / r of the attraction a and the tension b has the solution r = (R +
// sqrt(R^2 - 8 b / a)) / 2. The bias of the curvature shifts the radius by -0.016 h at n = 32. The
// tolerances are more than twice that.
void CheckBalance(const Balance& balance)
{
  const double h = VoxelSizeOf(balance.Nodes);
  const double radius = balance.TargetRadius;
  NarrowBand band(h);
  StartOn(band, MakeBall(balance.Centre, radius));
  ShapeTarget target(MakeBall(balance.Centre, radius));
  const Motion motion = MakeMotion(balance.Attraction, balance.Tension);
  band.Advance(14.0 / balance.Attraction, motion, target);
  const double under = radius * radius - 8.0 * balance.Tension / balance.Attraction;
  const double exact = 0.5 * (radius + std::sqrt(under));
  const Range radii = GetRadii(Polygonise(band), balance.Centre);
  const std::string name = "n = " + std::to_string(balance.Nodes) + ", attraction " +
    Number(balance.Attraction) + ", tension " + Number(balance.Tension) + ", R = " + Number(radius);
  EXPECT_NEAR((radii.Mean - exact) / h, 0.0, 0.04) << "error of the radius at rest [h], " << name;
  EXPECT_LT(radii.GetSpread() / h, 0.08) << "spread of the radii at rest [h], " << name;
}

TEST(TestRest, BallRestsWhereAttractionBalancesTension)
{
  CheckBalance({ 32, 1.0, 0.005, 0.6, CentreA });
  CheckBalance({ 32, 1.0, 0.02, 0.6, CentreA });
  CheckBalance({ 48, 1.0, 0.02, 0.6, CentreA });
  CheckBalance({ 64, 1.0, 0.02, 0.6, CentreA });
  CheckBalance({ 32, 1.0, 0.015, 0.5, CentreB });
  CheckBalance({ 32, 3.0, 0.03, 0.65, CentreB });
  CheckBalance({ 32, 10.0, 0.01, 0.4, CentreB });
}

// Draws 8 b / a up to R^2 / 2. Near R^2 the steady state is unstable, and any error moves it far.
TEST(TestRest, BallRestsWhereAttractionBalancesTensionAtRandom)
{
  RandomShapes random(6);
  for (const int n : { 32, 32, 32, 32, 48, 64 })
  {
    const Ball ball = random.DrawBallNear({ CentreA, 0.6 });
    const double attraction = random.DrawBetween(1.0, 10.0);
    const double tension =
      attraction * ball.Radius * ball.Radius / 16.0 * random.DrawBetween(0.1, 1.0);
    CheckBalance({ n, attraction, tension, ball.Radius, ball.Centre });
  }
}

// 8 b / a = 4/3 R^2 exceeds R^2, so no balance exists. The time to vanish is the integral of r dr /
// (r^2 - R r + 2 b) from 0 to R, 2 pi / sqrt(3) for a = 1 and all R.
void CheckCollapse(const Ball& ball)
{
  const double exact = 2.0 * Pi / std::sqrt(3.0);
  const double tension = ball.Radius * ball.Radius / 6.0;
  NarrowBand band(VoxelSizeOf(32));
  StartOn(band, MakeBall(ball.Centre, ball.Radius));
  ShapeTarget target(MakeBall(ball.Centre, ball.Radius));
  band.Advance(0.95 * exact, MakeMotion(1.0, tension), target);
  EXPECT_FALSE(band.IsEmpty()) << "the ball still exists 5 % before the exact time";
  const AdvanceReport report = band.Advance(1.05 * exact, MakeMotion(1.0, tension), target);
  EXPECT_TRUE(report.Vanished && band.IsEmpty()) << "the ball is gone 5 % after the exact time";
}

TEST(TestRest, BallBeyondBalanceCollapsesAtTheExactTime)
{
  CheckCollapse({ CentreA, 0.6 });
}

TEST(TestRest, BallBeyondBalanceCollapsesAtTheExactTimeAtRandom)
{
  RandomShapes random(7);
  for (int i = 0; i < 3; ++i)
  {
    CheckCollapse(random.DrawBallNear({ CentreA, 0.6 }));
  }
}

struct Journey
{
  const char* Name;
  Shape Start;
  Shape End;
};

// Without tension the surface ends on the target. Linear crossings are off by up to h^2 / 8 r.
// Normals are linear interpolations between central differences, and off by up to 9 degrees near a
// tube of 4 voxels or an edge between two bodies.
void CheckArrival(const Journey& journey)
{
  const double h = VoxelSizeOf(40);
  NarrowBand band(h);
  StartOn(band, journey.Start);
  ShapeTarget target(journey.End);
  Settle(band, target, 200);
  const Deviation deviation = GetDeviation(Polygonise(band), journey.End, h);
  const std::string name = journey.Name;
  EXPECT_FALSE(band.IsEmpty()) << name << " has a surface";
  EXPECT_LT(deviation.MeanDistance, 0.004) << name << ", mean distance to the target [h]";
  EXPECT_LT(deviation.LargestDistance, 0.06) << name << ", largest distance to the target [h]";
  EXPECT_LT(deviation.MeanAngle, 2.0) << name << ", mean error of the normals [degrees]";
  EXPECT_LT(deviation.LargestAngle, 9.0) << name << ", largest error of a normal [degrees]";
}

TEST(TestRest, SurfaceArrivesAtItsTarget)
{
  const Shape two = MakeBalls({ { { -0.43, 0.01, 0.02 }, 0.3 }, { { 0.45, 0.03, -0.01 }, 0.33 } });
  const Shape pair = MakeBalls({ { { -0.4, 0.06, 0.0 }, 0.33 }, { { 0.42, -0.02, 0.05 }, 0.28 } });
  const std::vector<Journey> journeys = { { "ball to ball", MakeBall(Origin, 0.4),
                                            MakeBall({ 0.21, 0.13, 0.07 }, 0.6) },
    { "ball to torus", MakeBall(Origin, 0.6), MakeTorus({ 0.01, 0.02, 0.013 }, 0.55, 0.22) },
    { "ball to wide torus", MakeBall(Origin, 0.7), MakeTorus({ -0.03, 0.02, 0.04 }, 0.5, 0.25) },
    { "ball to two balls", MakeBall(Origin, 0.5), two },
    { "ball to two other balls", MakeBall(Origin, 0.6), pair },
    { "ball to six metaballs", MakeBall(Origin, 0.35), MakeSixMetaballs() },
    { "ball to ellipsoid", MakeBall(Origin, 0.4), MakeEllipsoid({ 0.7, 0.5, 0.35 }) } };
  for (const Journey& journey : journeys)
  {
    CheckArrival(journey);
  }
}

// The metaballs are not smaller than above, because the error of their normals would exceed the
// tolerance.
TEST(TestRest, SurfaceArrivesAtItsTargetAtRandom)
{
  RandomShapes random(10);
  const auto draw = [&random](double radius)
  {
    const Ball ball = random.DrawBallNear({ Origin, radius });
    return MakeBall(ball.Centre, ball.Radius);
  };
  const Ball left = random.DrawBallNear({ { -0.43, 0.01, 0.02 }, 0.3 });
  const Ball right = random.DrawBallNear({ { 0.45, 0.03, -0.01 }, 0.33 });
  CheckArrival({ "ball to two balls", draw(0.5), MakeBalls({ left, right }) });
  const Point centre = random.DrawPointNear({ 0.01, 0.02, 0.013 });
  const double ring = random.DrawLengthNear(0.55);
  const Shape torus = MakeTorus(centre, ring, random.DrawLengthNear(0.22));
  CheckArrival({ "ball to torus", draw(0.6), torus });
  const Shape metaballs = Scale(MakeSixMetaballs(), random.DrawBetween(1.0, 1.1));
  CheckArrival(
    { "ball to six metaballs", draw(0.35), Move(metaballs, random.DrawPointNear(Origin)) });
  const Shape ellipsoid = MakeEllipsoid(
    { random.DrawLengthNear(0.7), random.DrawLengthNear(0.5), random.DrawLengthNear(0.35) });
  CheckArrival({ "ball to ellipsoid", draw(0.4), Move(ellipsoid, random.DrawPointNear(Origin)) });
}

struct ThinThing
{
  std::string Name;
  Shape Form;
  Topology Expected;
};

// Below 2 voxels the samples of the start may have holes, so the topology is not compared.
void CheckThinThing(const ThinThing& thing, bool compareTopology)
{
  const double h = VoxelSizeOf(32);
  NarrowBand band(h);
  StartOn(band, thing.Form);
  ShapeTarget target(thing.Form);
  Settle(band, target, 150);
  const Mesh mesh = Polygonise(band);
  EXPECT_FALSE(band.IsEmpty()) << thing.Name << " still exists";
  EXPECT_LT(GetDeviation(mesh, thing.Form, h).MeanDistance, 0.01) << thing.Name << ", distance [h]";
  if (compareTopology)
  {
    const Topology topology = GetTopology(mesh);
    const Topology& expected = thing.Expected;
    EXPECT_EQ(topology.Components, expected.Components) << thing.Name << ", components";
    EXPECT_EQ(topology.Voids, expected.Voids) << thing.Name << ", voids";
    EXPECT_EQ(topology.EulerCharacteristic, expected.EulerCharacteristic)
      << thing.Name << ", Euler characteristic";
  }
}

TEST(TestRest, ThinThingsStay)
{
  const double h = VoxelSizeOf(32);
  for (const double size : { 1.5, 2.0, 2.5, 3.0 })
  {
    const double width = size * h;
    const std::string name = " of " + Number(size) + " h";
    const bool compare = size >= 2.0;
    CheckThinThing({ "ball" + name, MakeBall(CentreA, width), { 1, 0, 2 } }, compare);
    const double inner = 0.5 - 0.5 * width;
    CheckThinThing(
      { "gap" + name, MakeBallInShell(0.8, 0.5 + 0.5 * width, inner), { 2, 1, 6 } }, compare);
    const double radius = 0.4 - 0.5 * width;
    const Shape two =
      MakeBalls({ { { -0.4, 0.01, 0.02 }, radius }, { { 0.4, 0.01, 0.02 }, radius } });
    CheckThinThing({ "gap between balls" + name, two, { 2, 0, 4 } }, compare);
    if (size <= 2.0)
    {
      CheckThinThing({ "shell" + name, MakeShell(0.6, 0.6 - width), { 1, 1, 4 } }, compare);
      const Shape slab = MakeSlab(0.3 * h, width, 0.6);
      CheckThinThing({ "slab" + name, slab, { 1, 0, 2 } }, compare);
    }
  }
  const Shape ring = MakeTorus({ 0.01, 0.02, 0.013 }, 0.55, 2.0 * h);
  CheckThinThing({ "ring with a tube of 2 h", ring, { 1, 0, 0 } }, true);
}

void CheckThinGaps(RandomShapes& random, double size)
{
  const double width = size * VoxelSizeOf(32);
  const std::string name = " of " + Number(size) + " h";
  const bool compare = size >= 2.0;
  const Shape ball = MakeBall(random.DrawPointNear(CentreA), width);
  CheckThinThing({ "ball" + name, ball, { 1, 0, 2 } }, compare);
  const double outer = random.DrawLengthNear(0.8);
  const double middle = random.DrawLengthNear(0.5);
  const Shape nested = Move(MakeBallInShell(outer, middle + 0.5 * width, middle - 0.5 * width),
    random.DrawPointNear(Origin));
  CheckThinThing({ "gap" + name, nested, { 2, 1, 6 } }, compare);
  const double left = random.DrawLengthNear(0.37);
  const double right = random.DrawLengthNear(0.37);
  const Shape two = Move(MakeBalls({ { { -left - 0.5 * width, 0.0, 0.0 }, left },
                           { { right + 0.5 * width, 0.0, 0.0 }, right } }),
    random.DrawPointNear(Origin));
  CheckThinThing({ "gap between balls" + name, two, { 2, 0, 4 } }, compare);
}

void CheckThinSheets(RandomShapes& random, double size)
{
  const double width = size * VoxelSizeOf(32);
  const std::string name = " of " + Number(size) + " h";
  const bool compare = size >= 2.0;
  const double radius = random.DrawLengthNear(0.6);
  const Shape shell = Move(MakeShell(radius, radius - width), random.DrawPointNear(Origin));
  CheckThinThing({ "shell" + name, shell, { 1, 1, 4 } }, compare);
  const Shape disk = MakeSlab(0.0, width, random.DrawLengthNear(0.6));
  const Shape slab = Move(disk, random.DrawPointNear(Origin));
  CheckThinThing({ "slab" + name, slab, { 1, 0, 2 } }, compare);
}

// Draws widths between those of ThinThingsStay.
TEST(TestRest, ThinThingsStayAtRandom)
{
  RandomShapes random(18);
  for (const auto& [least, most] :
    { std::pair(1.5, 2.0), std::pair(2.0, 2.5), std::pair(2.5, 3.0) })
  {
    CheckThinGaps(random, random.DrawBetween(least, most));
  }
  CheckThinSheets(random, random.DrawBetween(1.5, 2.0));
  CheckThinSheets(random, 2.0);
  const Point centre = random.DrawPointNear({ 0.01, 0.02, 0.013 });
  const Shape ring = MakeTorus(centre, random.DrawLengthNear(0.55), 2.0 * VoxelSizeOf(32));
  CheckThinThing({ "ring with a tube of 2 h", ring, { 1, 0, 0 } }, true);
}
}
