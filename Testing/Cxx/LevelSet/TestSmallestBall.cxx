// Smallest ball that a target maintains against tension. dr/dt = Attraction (R - r) - 2 Tension / r
// has two steady states if R > 2 sqrt(2 Tension / Attraction).

#include "Support/SurfaceMeasures.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace activesurface;

namespace TestSmallestBall
{

namespace
{

constexpr double VoxelSize = 0.02;
constexpr double LengthOfTension = 0.1; // sqrt(Tension / Attraction)

// Advances by 40 / Attraction. If a steady state exists, the rate of approach is 0.64 Attraction.
void Settle(NarrowBand& band, double radius)
{
  constexpr double bounds[6] = { -0.6, 0.6, -0.6, 0.6, -0.6, 0.6 };
  band.Start(0.0, bounds, MakeInitialFunction(MakeBall(CentreA, radius)));
  ShapeTarget target(MakeBall(CentreA, radius));
  Motion motion = MakeMotion(1.0, 0.0);
  motion.Tension = LengthOfTension * LengthOfTension;
  band.Advance(40.0, motion, target);
}

}

// The steady state under tension is accurate to 0.04 voxel (TestRest). Near the fold an error is
// amplified by 1 / (1 - 2 Tension / (Attraction r^2)) = 1.57.
TEST(TestSmallestBall, ABallAboveTheFoldRestsAtTheExactRadius)
{
  const double target = 3.2 * LengthOfTension;
  NarrowBand band(VoxelSize);
  Settle(band, target);
  const double exact =
    0.5 * target + std::sqrt(0.25 * target * target - 2.0 * LengthOfTension * LengthOfTension);
  EXPECT_FALSE(band.IsEmpty()) << "it lives";
  EXPECT_NEAR(GetRadii(Polygonise(band), CentreA).Mean, exact, 0.063 * VoxelSize) << "its radius";
}

TEST(TestSmallestBall, ABallBelowTheFoldVanishes)
{
  NarrowBand band(VoxelSize);
  Settle(band, 2.3 * LengthOfTension);
  EXPECT_TRUE(band.IsEmpty()) << "it vanishes";
}

}
