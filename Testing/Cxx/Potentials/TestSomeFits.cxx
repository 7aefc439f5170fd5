// Fits of some particles, as a rank needs them: the same bytes as when all are found.

#include "Support/SkeletonShapes.h"
#include "Support/ThreadRanks.h"

#include "MotionNoise.h"
#include "ParticleLengths.h"
#include "SomeFits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

using namespace activesurface;

namespace
{

constexpr double Spacing = 0.1;

FitOptions MakeOptions(ParticleModel model)
{
  FitOptions options;
  options.Model = model;
  return options;
}

// A long body, particles of any size; and a drop far from it.
std::vector<SkeletonVertex> MakeParticles(ParticleModel model)
{
  std::vector<SkeletonVertex> particles;
  Random random(5);
  for (int i = 0; i < 6000; ++i)
  {
    const double x = i == 77 ? 1e6 : random.Between(-4.0, 4.0);
    const double size = random.Between(0.8, 1.3);
    particles.push_back({ { x, random.Between(-0.3, 0.3), random.Between(-0.3, 0.3) },
      size * GetReachPerSpacing(model) * Spacing, i % 90 == 0 ? -1.0 : 1.0 });
  }
  return particles;
}

std::vector<std::size_t> ListBetween(
  const std::vector<SkeletonVertex>& particles, double low, double high)
{
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    if (particles[i].Position[0] >= low && particles[i].Position[0] < high)
    {
      numbers.push_back(i);
    }
  }
  return numbers;
}

bool IsSame(const ParticleFit& a, const ParticleFit& b)
{
  return std::memcmp(&a, &b, sizeof a) == 0;
}

void ExpectAsOfAll(const SomeFits& some, const ParticleFits& all,
  const std::vector<std::size_t>& wanted, const std::string& what)
{
  std::size_t different = 0, whole = 0, found = 0;
  for (std::size_t k = 0; k < some.Numbers.size(); ++k)
  {
    const std::size_t i = some.Numbers[k];
    const bool isWhole = some.AreWhole[k] != 0;
    whole += isWhole;
    found += isWhole && std::binary_search(wanted.begin(), wanted.end(), i);
    different += isWhole ? !IsSame(some.Fits[k], all[i]) : some.Fits[k].Bulk != all[i].Bulk;
  }
  EXPECT_EQ(different, 0u) << what;
  EXPECT_EQ(found, wanted.size()) << what;
  EXPECT_GT(some.Numbers.size(), whole) << "neighbours, " << what;
  EXPECT_LT(some.Numbers.size(), all.size() / 2) << "no more than matter, " << what;
}

const ParticleModel Models[] = { ParticleModel::Sum, ParticleModel::AveragedCentre,
  ParticleModel::Anisotropic };

}

TEST(TestSomeFits, AreThoseOfAllWhateverWasKnown)
{
  for (const ParticleModel model : Models)
  {
    const std::vector<SkeletonVertex> particles = MakeParticles(model);
    const ParticleFits all = FitParticles(MakeOptions(model), particles);
    SomeFits some;
    for (const double low : { -0.8, -0.7, 0.1, -4.0, 0.1 })
    {
      const std::vector<std::size_t> wanted = ListBetween(particles, low, low + 0.5);
      FindSomeFits(MakeOptions(model), particles, wanted, some);
      ExpectAsOfAll(some, all, wanted,
        "model " + std::to_string(static_cast<int>(model)) + " from " + std::to_string(low));
    }
  }
}

TEST(TestSomeFits, OfNoneThereAreNone)
{
  const std::vector<SkeletonVertex> particles = MakeParticles(ParticleModel::AveragedCentre);
  const FitOptions options = MakeOptions(ParticleModel::AveragedCentre);
  SomeFits some;
  FindSomeFits(options, particles, ListBetween(particles, 0.0, 0.2), some);
  FindSomeFits(options, particles, {}, some);
  EXPECT_TRUE(some.Numbers.empty());
  FindSomeFits(options, {}, {}, some);
  EXPECT_TRUE(some.Fits.empty());
}

TEST(TestSomeFits, SharesOfMotionAreThoseOfAll)
{
  const ParticleModel model = ParticleModel::AveragedCentre;
  const std::vector<SkeletonVertex> particles = MakeParticles(model);
  std::vector<double> velocities;
  Random random(9);
  for (std::size_t i = 0; i < particles.size(); ++i)
  {
    for (const double mean : { 0.3, 0.0, 0.0 })
    {
      velocities.push_back(i % 50 == 0 ? std::nan("") : mean + random.Between(-1.0, 1.0));
    }
  }
  const ParticleFits all = FitParticles(MakeOptions(model), particles);
  const std::vector<double> shares = FindSharesOfMotion(particles, all, velocities);
  SomeFits some;
  FindSomeFits(MakeOptions(model), particles, ListBetween(particles, -0.3, 0.3), some);
  std::vector<SkeletonVertex> here;
  std::vector<double> ofHere;
  for (const std::size_t i : some.Numbers)
  {
    here.push_back(particles[i]);
    ofHere.insert(ofHere.end(), &velocities[3 * i], &velocities[3 * i] + 3);
  }
  const std::vector<double> found = FindSharesOfMotion(
    here, some.Fits, ofHere, MovingPart{ some.AreWhole, FindLargestRadius(particles) });
  std::size_t noisy = 0;
  for (std::size_t k = 0; k < found.size(); ++k)
  {
    EXPECT_EQ(found[k], some.AreWhole[k] ? shares[some.Numbers[k]] : 1.0);
    noisy += found[k] < 0.9;
  }
  EXPECT_GT(noisy, 20u);
}

// So many in one place that a rank alone does not see them all.
TEST(TestSomeFits, RanksFindTheSameCrowds)
{
  for (const bool isCrowd : { false, true })
  {
    std::vector<SkeletonVertex> particles;
    Random random(4);
    for (int i = 0; i < 32000; ++i)
    {
      const double size = isCrowd ? 0.01 : 4.0;
      particles.push_back({ { size * random.Between(-1.0, 1.0), size * random.Between(-1.0, 1.0),
                              size * random.Between(-1.0, 1.0) },
        0.3, 1.0 });
    }
    std::atomic<int> refused{ 0 }, spared{ 0 };
    RunOnRanks(3,
      [&](Agreement& ranks)
      {
        FitOptions options = MakeOptions(ParticleModel::AveragedCentre);
        options.Ranks = &ranks;
        try
        {
          AreCrowded(options, particles);
        }
        catch (const std::invalid_argument&)
        {
          ++refused;
        }
        options.SparesCrowds = true;
        spared += AreCrowded(options, particles);
      });
    EXPECT_EQ(refused, isCrowd ? 3 : 0);
    EXPECT_EQ(spared, isCrowd ? 3 : 0);
  }
}
