// Bodies, voids and handles become those of the target, without special treatment, where the
// surface can move to.

#include "Support/RandomShapes.h"
#include "Support/SurfaceMeasures.h"

#include <gtest/gtest.h>

#include <string>

using namespace activesurface;

namespace TestTopology
{
constexpr Point Origin = { 0.0, 0.0, 0.0 };

constexpr Ball Left = { { -0.43, 0.01, 0.02 }, 0.3 };
constexpr Ball Right = { { 0.45, 0.03, -0.01 }, 0.33 };

Shape MakeTwoBalls()
{
  return MakeBalls({ Left, Right });
}

Shape DrawBall(RandomShapes& random, const Ball& ball)
{
  const Ball drawn = random.DrawBallNear(ball);
  return MakeBall(drawn.Centre, drawn.Radius);
}

Shape DrawTwoBalls(RandomShapes& random)
{
  const Ball left = random.DrawBallNear(Left);
  return MakeBalls({ left, random.DrawBallNear(Right) });
}

Shape DrawTorus(RandomShapes& random, double ringRadius, double tubeRadius)
{
  const Point centre = random.DrawPointNear({ 0.01, 0.02, 0.013 });
  const double ring = random.DrawLengthNear(ringRadius);
  return MakeTorus(centre, ring, random.DrawLengthNear(tubeRadius));
}

Shape DrawShell(RandomShapes& random, double outerRadius, double innerRadius)
{
  const double outer = random.DrawLengthNear(outerRadius);
  const double inner = random.DrawLengthNear(innerRadius);
  return Move(MakeShell(outer, inner), random.DrawPointNear(Origin));
}

// The tests at random draw centres within 0.05 and radii within 10 %.

// Twelve time constants after the start, e^-12 of the distance remains: 0.0001 h.
void CheckTopology(const Shape& start, const Shape& end, const Topology& expected, int n = 40)
{
  for (const double tension : { 0.0, 0.005 })
  {
    NarrowBand band(VoxelSizeOf(n));
    StartOn(band, start);
    ShapeTarget target(end);
    Motion motion = MakeMotion(1.0, 0.0);
    motion.Tension = tension;
    const AdvanceReport report = band.Advance(12.0, motion, target);
    const Mesh mesh = Polygonise(band);
    const Topology topology = GetTopology(mesh);
    const std::string name = tension > 0.0 ? "with tension" : "without tension";
    EXPECT_EQ(topology.Components, expected.Components) << "bodies, " << name;
    EXPECT_EQ(topology.Voids, expected.Voids) << "voids, " << name;
    EXPECT_EQ(topology.EulerCharacteristic, expected.EulerCharacteristic)
      << "Euler number, " << name;
    EXPECT_EQ(FindDefects(mesh).Edges, 0u) << "edges that are not in two triangles, " << name;
    EXPECT_TRUE(report.Vanished == (expected.Components == 0)) << "report.Vanished, " << name;
  }
}

TEST(TestTopology, OneBallBecomesTwo)
{
  CheckTopology(MakeBall(Origin, 0.5), MakeTwoBalls(), { 2, 0, 4 });
}

TEST(TestTopology, OneBallBecomesTwoAtRandom)
{
  RandomShapes random(171);
  const Shape start = DrawBall(random, { Origin, 0.5 });
  CheckTopology(start, DrawTwoBalls(random), { 2, 0, 4 });
}

TEST(TestTopology, TwoBallsBecomeOne)
{
  CheckTopology(MakeTwoBalls(), MakeBall({ 0.01, 0.02, 0.0 }, 0.6), { 1, 0, 2 });
}

TEST(TestTopology, TwoBallsBecomeOneAtRandom)
{
  RandomShapes random(172);
  const Shape start = DrawTwoBalls(random);
  CheckTopology(start, DrawBall(random, { { 0.01, 0.02, 0.0 }, 0.6 }), { 1, 0, 2 });
}

TEST(TestTopology, BallBecomesATorus)
{
  const Shape torus = MakeTorus({ 0.01, 0.02, 0.013 }, 0.55, 0.2);
  CheckTopology(MakeBall(Origin, 0.6), torus, { 1, 0, 0 });
}

TEST(TestTopology, BallBecomesATorusAtRandom)
{
  RandomShapes random(173);
  const Shape start = DrawBall(random, { Origin, 0.6 });
  CheckTopology(start, DrawTorus(random, 0.55, 0.2), { 1, 0, 0 });
}

TEST(TestTopology, TorusBecomesABall)
{
  const Shape torus = MakeTorus({ 0.01, 0.02, 0.013 }, 0.5, 0.2);
  CheckTopology(torus, MakeBall({ 0.01, 0.03, 0.02 }, 0.6), { 1, 0, 2 });
}

TEST(TestTopology, TorusBecomesABallAtRandom)
{
  RandomShapes random(174);
  const Shape start = DrawTorus(random, 0.5, 0.2);
  CheckTopology(start, DrawBall(random, { { 0.01, 0.03, 0.02 }, 0.6 }), { 1, 0, 2 });
}

TEST(TestTopology, OneOfTwoBallsVanishes)
{
  CheckTopology(MakeTwoBalls(), MakeBall({ -0.4, 0.0, 0.0 }, 0.32), { 1, 0, 2 });
}

TEST(TestTopology, OneOfTwoBallsVanishesAtRandom)
{
  RandomShapes random(175);
  const Shape start = DrawTwoBalls(random);
  CheckTopology(start, DrawBall(random, { { -0.4, 0.0, 0.0 }, 0.32 }), { 1, 0, 2 });
}

// No surface could move to the surface of the void.
TEST(TestTopology, VoidOfTheTargetAloneIsNotMade)
{
  CheckTopology(MakeBall(Origin, 0.6), MakeShell(0.7, 0.3), { 1, 0, 2 });
}

TEST(TestTopology, VoidOfTheTargetAloneIsNotMadeAtRandom)
{
  RandomShapes random(176);
  const Shape start = DrawBall(random, { Origin, 0.6 });
  CheckTopology(start, DrawShell(random, 0.7, 0.3), { 1, 0, 2 });
}

TEST(TestTopology, VoidCloses)
{
  CheckTopology(MakeShell(0.7, 0.3), MakeBall(Origin, 0.65), { 1, 0, 2 });
}

TEST(TestTopology, VoidClosesAtRandom)
{
  RandomShapes random(177);
  const Shape start = DrawShell(random, 0.7, 0.3);
  CheckTopology(start, DrawBall(random, { Origin, 0.65 }), { 1, 0, 2 });
}

TEST(TestTopology, VoidMoves)
{
  CheckTopology(MakeShell(0.5, 0.4), MakeShell(0.7, 0.25), { 1, 1, 4 });
}

// Start and target have one centre, so that the target's void is within the start's.
TEST(TestTopology, VoidMovesAtRandom)
{
  RandomShapes random(178);
  const Point centre = random.DrawPointNear(Origin);
  const double inner = random.DrawLengthNear(0.4);
  const Shape start = Move(MakeShell(inner + 0.1, inner), centre);
  const double goal = random.DrawLengthNear(0.7);
  const Shape end = Move(MakeShell(goal, random.DrawLengthNear(0.25)), centre);
  CheckTopology(start, end, { 1, 1, 4 });
}

// The ball shrinks with the distance to the target's ball, and cannot jump there.
TEST(TestTopology, BallApartFromItsTargetVanishes)
{
  const Shape start = MakeBall({ -0.5, 0.0, 0.0 }, 0.25);
  CheckTopology(start, MakeBall({ 0.5, 0.0, 0.0 }, 0.25), { 0, 0, 0 });
}

TEST(TestTopology, BallApartFromItsTargetVanishesAtRandom)
{
  RandomShapes random(179);
  const Shape start = DrawBall(random, { { -0.5, 0.0, 0.0 }, 0.25 });
  CheckTopology(start, DrawBall(random, { { 0.5, 0.0, 0.0 }, 0.25 }), { 0, 0, 0 });
}

// Under tension the case is marginal at n = 40: the lens that both balls share is 0.1 thick, two
// voxels.
TEST(TestTopology, SmallOverlapIsEnoughToArrive)
{
  const Shape start = MakeBall({ -0.2, 0.0, 0.0 }, 0.3);
  for (const int n : { 40, 64 })
  {
    CheckTopology(start, MakeBall({ 0.3, 0.0, 0.0 }, 0.3), { 1, 0, 2 }, n);
  }
}

// The balls are not smaller than above: the lens of smaller balls is narrower, and tension may make
// it vanish.
TEST(TestTopology, SmallOverlapIsEnoughToArriveAtRandom)
{
  RandomShapes random(180);
  const Point centre = random.DrawPointNear({ -0.2, 0.0, 0.0 });
  const double radius = random.DrawBetween(0.3, 0.33);
  const double goal = random.DrawBetween(0.3, 0.33);
  const Point beyond = { centre[0] + radius + goal - 0.1, centre[1], centre[2] };
  for (const int n : { 40, 64 })
  {
    CheckTopology(MakeBall(centre, radius), MakeBall(beyond, goal), { 1, 0, 2 }, n);
  }
}
}
