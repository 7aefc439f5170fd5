// What is noise in the velocities of particles, and what is left of it in their means.

#include "MotionNoise.h"
#include "ParticleMeans.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

using namespace activesurface;

namespace TestMotionNoise
{

namespace
{

constexpr double Reach = 4.5; // of particles at a distance of 1 from each other
constexpr int Side = 12;
constexpr int Count = Side * Side * Side;

// A block of particles, whose velocity is this and a share of normal noise.
struct Block
{
  std::vector<SkeletonVertex> Particles;
  ParticleFits Fits;
  std::vector<double> Velocities;

  Block(const double velocity[3], double noise, double bulk)
    : Fits(Count)
  {
    std::mt19937_64 generator(7);
    std::normal_distribution<double> normal;
    for (int i = 0; i < Count; ++i)
    {
      this->Particles.push_back(
        { { double(i % Side), double(i / Side % Side), double(i / Side / Side) }, Reach, 1.0 });
      this->Fits[i].Bulk = bulk;
      for (int axis = 0; axis < 3; ++axis)
      {
        this->Velocities.push_back(velocity[axis] + noise * normal(generator));
      }
    }
  }

  std::vector<double> FindShares() const
  {
    const LocalParticles all(this->Particles, nullptr, MotionNeighbourhoodPerRadius, 0.0);
    return FindSharesOfMotion(all, this->Fits, this->Velocities);
  }

  // So far above the particles of the top.
  std::vector<double> EvaluateAbove(double height, bool leavesNoise) const
  {
    const std::vector<double> shares = this->FindShares();
    ParticleMeans means;
    std::vector<double> carried;
    for (std::size_t i = 0; i < Count; ++i)
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        carried.push_back(this->Velocities[3 * i + axis] * (leavesNoise ? shares[i] : 1.0));
      }
    }
    means.Build(this->Particles, { carried, this->Fits });
    std::vector<double> places;
    for (int i = 0; i < 400; ++i)
    {
      places.insert(
        places.end(), { 2.0 + 0.35 * (i % 20), 2.0 + 0.35 * (i / 20), Side - 1 + height });
    }
    std::vector<double> velocities(places.size());
    means.Evaluate(places.size() / 3, places.data(), velocities.data(), nullptr);
    return velocities;
  }
};

double GetLength(const double* v)
{
  return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

double GetMeanLength(const std::vector<double>& velocities)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < velocities.size(); i += 3)
  {
    sum += GetLength(&velocities[i]);
  }
  return sum / static_cast<double>(velocities.size() / 3);
}

constexpr double Still[3] = { 0.0, 0.0, 0.0 };
constexpr double Together[3] = { 0.0, 2.0, 1.0 };

}

// Chance leaves one mean in 2000, and those are neighbours of each other. Near the end of all
// reaches few particles are in a mean, so that it tells nothing of its error: the particles' own
// shares do.
TEST(TestMotionNoise, RandomVelocitiesOfABodyAreNoiseWhereverTheyReach)
{
  const Block block(Still, 1.0, 1.0);
  for (const double height : { 0.5, 3.0, 4.2 })
  {
    const double with = GetMeanLength(block.EvaluateAbove(height, false));
    EXPECT_GT(with, 0.1) << "of velocities of length 1.7";
    EXPECT_LT(GetMeanLength(block.EvaluateAbove(height, true)), with / 50.0) << height;
  }
}

// Where there is a mean, 6 |error|^2 / |mean|^2 of it is left out: of 2.2 and an error of .2, .05.
TEST(TestMotionNoise, AMotionInCommonIsNoNoise)
{
  for (const double share : Block(Together, 0.0, 1.0).FindShares())
  {
    EXPECT_NEAR(share, 1.0, 1e-12);
  }
  const Block noisy(Together, 1.0, 1.0);
  const double length = GetLength(Together);
  const double all = GetMeanLength(noisy.EvaluateAbove(0.5, false));
  const double kept = GetMeanLength(noisy.EvaluateAbove(0.5, true));
  EXPECT_NEAR(all, length, 0.05 * length);
  EXPECT_NEAR(kept, all, 0.1 * length);
  EXPECT_LT(kept, all);
}

TEST(TestMotionNoise, ParticlesThatAreNoBodyKeepTheirVelocity)
{
  EXPECT_EQ(Block(Still, 1.0, 0.0).FindShares(), std::vector<double>(Count, 1.0));
  for (const double share : Block(Still, 1.0, 0.2).FindShares())
  {
    EXPECT_GE(share, 0.6 - 1e-12) << "1 - 2 bulk at least";
    EXPECT_LE(share, 1.0);
  }
}

// As of births, which come from nowhere.
TEST(TestMotionNoise, UnknownVelocitiesCountNowhere)
{
  Block block(Together, 0.0, 1.0);
  const std::size_t unknown = Count / 2;
  block.Velocities[3 * unknown + 1] = std::numeric_limits<double>::quiet_NaN();
  for (const double share : block.FindShares())
  {
    EXPECT_NEAR(share, 1.0, 1e-12);
  }
}

}
