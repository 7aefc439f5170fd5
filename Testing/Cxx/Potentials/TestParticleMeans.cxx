// The mean velocity of particles around a place, and what is noise in it.

#include "ParticleMeans.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

using namespace activesurface;

namespace
{

constexpr double Reach = 4.5; // of particles at a distance of 1 from each other
constexpr int Side = 12;

// A block of particles, whose velocity is this and a share of normal noise.
ParticleMeans MakeBlock(const double velocity[3], double noise, double bulk, bool leavesNoise)
{
  std::mt19937_64 generator(7);
  std::normal_distribution<double> normal;
  ParticleMeans means;
  means.Clear(leavesNoise);
  for (int i = 0; i < Side * Side * Side; ++i)
  {
    const SkeletonVertex particle{
      { double(i % Side), double(i / Side % Side), double(i / Side / Side) }, Reach, 1.0
    };
    double own[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      own[axis] = velocity[axis] + noise * normal(generator);
    }
    means.Add(particle, own, bulk);
  }
  means.Build();
  return means;
}

// On the top of the block.
std::vector<double> MakePlaces()
{
  std::vector<double> places;
  for (int i = 0; i < 400; ++i)
  {
    places.insert(places.end(), { 2.0 + 0.35 * (i % 20), 2.0 + 0.35 * (i / 20), Side - 0.5 });
  }
  return places;
}

std::vector<double> Evaluate(const ParticleMeans& means)
{
  const std::vector<double> places = MakePlaces();
  std::vector<double> velocities(places.size());
  means.Evaluate(places.size() / 3, places.data(), velocities.data(), nullptr);
  return velocities;
}

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

// Chance leaves one mean in 2000, and those are neighbours of each other: one in fifty here.
TEST(TestParticleMeans, RandomVelocitiesOfABodyAreNoise)
{
  const double with = GetMeanLength(Evaluate(MakeBlock(Still, 1.0, 1.0, false)));
  EXPECT_GT(with, 0.1) << "of about sixty velocities of length 1.7";
  EXPECT_LT(GetMeanLength(Evaluate(MakeBlock(Still, 1.0, 1.0, true))), with / 50.0);
}

// Where there is a mean, 6 |error|^2 / |mean|^2 of it is left out: of 2.2 and an error of .2, .05.
TEST(TestParticleMeans, AMotionInCommonIsNoNoise)
{
  const std::vector<double> exact = Evaluate(MakeBlock(Together, 0.0, 1.0, true));
  for (std::size_t i = 0; i < exact.size(); ++i)
  {
    EXPECT_NEAR(exact[i], Together[i % 3], 1e-12);
  }
  const double length = GetLength(Together);
  const double all = GetMeanLength(Evaluate(MakeBlock(Together, 1.0, 1.0, false)));
  const double kept = GetMeanLength(Evaluate(MakeBlock(Together, 1.0, 1.0, true)));
  EXPECT_NEAR(all, length, 0.05 * length);
  EXPECT_NEAR(kept, all, 0.1 * length);
  EXPECT_LT(kept, all);
}

TEST(TestParticleMeans, ParticlesThatAreNoBodyKeepTheirVelocity)
{
  const std::vector<double> before = Evaluate(MakeBlock(Still, 1.0, 0.0, false));
  EXPECT_EQ(Evaluate(MakeBlock(Still, 1.0, 0.0, true)), before);
  const std::vector<double> body = Evaluate(MakeBlock(Still, 1.0, 0.2, true));
  for (std::size_t i = 0; i < body.size(); ++i)
  {
    EXPECT_LE(std::fabs(body[i]), std::fabs(before[i]));
    EXPECT_GE(std::fabs(body[i]), 0.6 * std::fabs(before[i]) - 1e-12) << "1 - 2 bulk at least";
  }
}
