// Motion by tension only, without a target. The exact radius of a ball under tension b is sqrt(r0^2
// - 4 b t), because the sum of its principal curvatures is 2 / r.

#include "Support/RandomShapes.h"
#include "Support/SurfaceMeasures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

using namespace activesurface;

namespace TestTension
{
// The substep is factor * h^2 / Tension: a CFL of 1 is a factor of 1/4.
Motion TensionAlone(double factor)
{
  Motion motion = MakeMotion(1.0, 0.0);
  motion.Attraction = 0.0;
  motion.Tension = 1.0;
  motion.CFL = 4.0 * factor;
  return motion;
}

double TimeToShrink(double from, double to)
{
  return (from * from - to * to) / 4.0;
}

std::string Name(int n, double factor, double radius)
{
  return "n = " + std::to_string(n) + ", dt = " + std::to_string(factor).substr(0, 4) +
    " h^2, r = " + std::to_string(radius).substr(0, 4);
}

struct Milestone
{
  double Radius;
  double RelativeTolerance;
};

struct ShrinkingBall
{
  int Nodes;
  double Factor;
  Point Centre;
  double StartRadius;
  std::vector<Milestone> Milestones;
};

// The error is second order in space. Measured: 0.10, 0.22, 0.99 % at n = 32; 0.032, 0.083, 0.35 %
// at n = 64; 0.011, 0.034 % at n = 128.
void CheckShrinking(const ShrinkingBall& ball)
{
  const double h = VoxelSizeOf(ball.Nodes);
  NarrowBand band(h);
  StartOn(band, MakeBall(ball.Centre, ball.StartRadius));
  ShapeTarget none(MakeConstant(0.0));
  for (const Milestone& milestone : ball.Milestones)
  {
    const double radius = milestone.Radius;
    band.Advance(TimeToShrink(ball.StartRadius, radius), TensionAlone(ball.Factor), none);
    const Mesh mesh = Polygonise(band);
    const Range radii = GetRadii(mesh, ball.Centre);
    const std::string name = Name(ball.Nodes, ball.Factor, radius);
    EXPECT_NEAR(radii.Mean / radius, 1.0, milestone.RelativeTolerance) << "mean radius, " << name;
    if (radius >= 0.5 * ball.StartRadius)
    {
      const Deviation deviation = GetDeviation(mesh, MakeBall(ball.Centre, radius), h);
      EXPECT_LT(radii.GetSpread() / h, 0.04) << "spread of the radii [h], " << name;
      EXPECT_LT(deviation.LargestAngle, 0.2) << "largest error of a normal [degrees], " << name;
    }
  }
}

TEST(TestTension, ShrinkingBallHasExactRadius)
{
  for (const double factor : { 0.1, 0.2, 0.25 })
  {
    CheckShrinking(
      { 32, factor, CentreA, 0.6, { { 0.45, 0.0015 }, { 0.3, 0.0035 }, { 0.15, 0.015 } } });
    CheckShrinking(
      { 64, factor, CentreA, 0.6, { { 0.45, 0.0005 }, { 0.3, 0.0012 }, { 0.15, 0.005 } } });
  }
  CheckShrinking({ 128, 0.25, CentreA, 0.6, { { 0.45, 0.0002 }, { 0.3, 0.0005 } } });
}

// The centre and the radii were not used to choose any constant of the scheme.
TEST(TestTension, ShrinkingBallHasExactRadiusElsewhere)
{
  CheckShrinking({ 32, 0.25, CentreB, 0.65, { { 0.5, 0.0015 }, { 0.35, 0.0035 } } });
  CheckShrinking({ 64, 0.25, CentreB, 0.65, { { 0.5, 0.0005 }, { 0.35, 0.0012 } } });
}

// The milestones are 3/4, 1/2 and 1/4 of the start radius. Errors are proportional to h^2 / r^2:
// 1.23 times as large for the smallest start as for 0.6.
ShrinkingBall DrawShrinkingBall(
  RandomShapes& random, int n, double factor, const std::vector<double>& tolerances)
{
  const Ball start = random.DrawBallNear({ CentreA, 0.6 });
  ShrinkingBall ball = { n, factor, start.Centre, start.Radius, {} };
  double part = 0.75;
  for (const double tolerance : tolerances)
  {
    ball.Milestones.push_back({ part * start.Radius, tolerance });
    part -= 0.25;
  }
  return ball;
}

TEST(TestTension, ShrinkingBallHasExactRadiusAtRandom)
{
  RandomShapes random(2);
  for (const double factor : { 0.1, 0.2, 0.25 })
  {
    CheckShrinking(DrawShrinkingBall(random, 32, factor, { 0.0015, 0.0035, 0.015 }));
    CheckShrinking(DrawShrinkingBall(random, 64, factor, { 0.0005, 0.0012, 0.005 }));
  }
  CheckShrinking(DrawShrinkingBall(random, 128, 0.25, { 0.0002, 0.0005 }));
}

// The last voxel of the ball is no sphere on the lattice, hence the tolerance of 5 %.
void CheckVanishing(const Ball& ball, double factor)
{
  const double h = VoxelSizeOf(32);
  const double exact = TimeToShrink(ball.Radius, 0.0);
  NarrowBand band(h);
  StartOn(band, MakeBall(ball.Centre, ball.Radius));
  ShapeTarget none(MakeConstant(0.0));
  int steps = 0;
  while (!band.IsEmpty() && steps * factor * h * h < 3.0 * exact)
  {
    ++steps;
    band.Advance(steps * factor * h * h, TensionAlone(0.25), none);
  }
  EXPECT_NEAR(steps * factor * h * h / exact, 1.0, 0.05)
    << "time of vanishing, " << Name(32, factor, ball.Radius);
}

TEST(TestTension, BallVanishesAtTheExactTime)
{
  for (const double factor : { 0.06, 0.24 })
  {
    CheckVanishing({ CentreA, 0.3 }, factor);
  }
}

TEST(TestTension, BallVanishesAtTheExactTimeAtRandom)
{
  RandomShapes random(3);
  for (const double factor : { 0.06, 0.06, 0.06, 0.24, 0.24, 0.24 })
  {
    CheckVanishing(random.DrawBallNear({ CentreA, 0.3 }), factor);
  }
}

// A number in [-1, 1] that depends only on the nearest node.
double NoiseAt(const Point& point, double h)
{
  std::uint32_t bits = 2166136261u;
  for (const double coordinate : point)
  {
    bits = (bits ^ static_cast<std::uint32_t>(std::lround(coordinate / h) + 1000)) * 16777619u;
    bits ^= bits >> 15;
    bits *= 2246822519u;
    bits ^= bits >> 13;
  }
  return bits / 2147483648.0 - 1.0;
}

// Returns 1e30 if no surface remains, or if the noise exceeds the maximum of active voxels that
// StartOn sets.
double SpreadFromNoise(const Ball& ball, double factor)
{
  const double h = VoxelSizeOf(32);
  Shape noisy = MakeBall(ball.Centre, ball.Radius);
  noisy.Value = [h, smooth = noisy.Value](const Point& point)
  { return smooth(point) + 0.05 * h * NoiseAt(point, h); };
  NarrowBand band(h);
  StartOn(band, noisy);
  ShapeTarget none(MakeConstant(0.0));
  try
  {
    band.Advance(TimeToShrink(0.6, 0.42), TensionAlone(factor), none);
  }
  catch (const std::runtime_error&)
  {
    return 1e30;
  }
  return band.IsEmpty() ? 1e30 : GetRadii(Polygonise(band), ball.Centre).GetSpread() / h;
}

// The potential is linear along its normal, so only two of the three second differences act. The
// largest stable factor is therefore 1/4.
void CheckStability(const Ball& ball)
{
  EXPECT_LT(SpreadFromNoise(ball, 0.25), 0.06) << "spread [h] from noise at dt = .25 h^2 / Tension";
  EXPECT_GT(SpreadFromNoise(ball, 0.30), 1.0) << "spread [h] from noise at dt = .30 h^2 / Tension";
}

TEST(TestTension, TheStableTimeStepIsAQuarter)
{
  CheckStability({ CentreA, 0.6 });
}

TEST(TestTension, TheStableTimeStepIsAQuarterAtRandom)
{
  RandomShapes random(11);
  for (int i = 0; i < 3; ++i)
  {
    CheckStability(random.DrawBallNear({ CentreA, 0.6 }));
  }
}
}
