// Estimate of the particles' spacing, and its cost.

#include "Frames/ParticleSpacing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <ctime>
#include <random>
#include <vector>

using namespace activesurface;

namespace TestParticleSpacing
{

namespace
{

constexpr double Spacing = 0.1;

void Add(ParticleFrame& frame, double x, double y, double z)
{
  frame.Particles.Add({ { x, y, z }, 1.0, 1.0 });
}

// A cubic lattice with a corner at (x, 0, 0).
ParticleFrame MakeLattice(int across, double x = 0.0, double unit = 1.0)
{
  ParticleFrame frame;
  for (int i = 0; i < across * across * across; ++i)
  {
    Add(frame, unit * (x + Spacing * (i % across)), unit * (Spacing * (i / across % across)),
      unit * (Spacing * (i / across / across)));
  }
  return frame;
}

double GetSeconds(const ParticleFrame& frame)
{
  const std::clock_t begin = std::clock();
  EXPECT_NEAR(FindSpacing(frame), Spacing, 1e-6 * Spacing);
  return double(std::clock() - begin) / CLOCKS_PER_SEC;
}

}

TEST(TestParticleSpacing, IsTheDistanceOfALatticesNeighbours)
{
  EXPECT_NEAR(FindSpacing(MakeLattice(10)), Spacing, 1e-12);
  ParticleFrame sheet;
  for (int i = 0; i < 900; ++i)
  {
    Add(sheet, Spacing * (i % 30), Spacing * (i / 30), 0.0);
  }
  EXPECT_NEAR(FindSpacing(sheet), Spacing, 1e-12);
}

TEST(TestParticleSpacing, OverlapIsADiameterPerSpacing)
{
  ParticleFrame frame = MakeLattice(10); // support radius 1
  EXPECT_NEAR(FindOverlap(frame), 2.0 / Spacing, 1e-9);
  frame.UseRadii(4.0);
  EXPECT_NEAR(FindOverlap(frame), 2.0 / Spacing, 1e-9) << "the radii of the array are the same";
}

// The ball to the third nearest of random points has a median volume of 2.674 over their density.
TEST(TestParticleSpacing, OfRandomPointsIsNearlyTheRootOfTheirVolume)
{
  std::mt19937_64 generator(3);
  std::uniform_real_distribution<double> place(0.0, 20.0 * Spacing);
  ParticleFrame frame;
  for (int i = 0; i < 8000; ++i)
  {
    const double x = place(generator), y = place(generator);
    Add(frame, x, y, place(generator));
  }
  EXPECT_NEAR(FindSpacing(frame), 0.861 * Spacing, 0.03 * Spacing);
}

TEST(TestParticleSpacing, IsNoneWithoutTwoPlaces)
{
  ParticleFrame frame;
  EXPECT_EQ(FindSpacing(frame), 0.0);
  for (int i = 0; i < 5; ++i)
  {
    Add(frame, 1.0, 2.0, 3.0);
    EXPECT_EQ(FindSpacing(frame), 0.0) << i + 1 << " in one place";
  }
  ParticleFrame pair = MakeLattice(1);
  Add(pair, 0.0, Spacing, 0.0);
  EXPECT_NEAR(FindSpacing(pair), Spacing, 1e-12);
}

// In single precision, coordinates near 10^6 are multiples of 0.0625, so neighbours would be 0.0625
// or 0.125 apart.
TEST(TestParticleSpacing, IsExactFarFromTheOrigin)
{
  EXPECT_NEAR(FindSpacing(MakeLattice(20, 1e6)), Spacing, 1e-8);
  ParticleFrame stray = MakeLattice(20, 1e6);
  Add(stray, -1e6, 1e6, 0.0);
  EXPECT_NEAR(FindSpacing(stray), Spacing, 1e-8);
}

// Neither the unit of length nor points far away change the result.
TEST(TestParticleSpacing, HasNoUnitOfItsOwn)
{
  for (const double unit : { 1e-100, 1e-25, 1e25, 1e100 })
  {
    ParticleFrame frame = MakeLattice(12, 0.0, unit);
    EXPECT_NEAR(FindSpacing(frame) / unit, Spacing, 1e-6) << unit;
    Add(frame, 1.7e308, -1.7e308, 1.7e308);
    Add(frame, -1.7e308, 1.7e308, 0.0);
    EXPECT_NEAR(FindSpacing(frame) / unit, Spacing, 1e-6) << unit << ", with strays";
  }
}

// With bins of one size, all particles but the stray would be in one bin, and each sample would
// search all of them.
TEST(TestParticleSpacing, AStrayCostsNothing)
{
  const ParticleFrame frame = MakeLattice(40);
  ParticleFrame stray = frame;
  Add(stray, 1e6 * Spacing, 0.0, 0.0);
  GetSeconds(frame); // loads and allocates once
  const double without = GetSeconds(frame);
  EXPECT_LT(GetSeconds(stray), 10.0 * without);
}

}
