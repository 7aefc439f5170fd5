// Fits that ranks share: each finds those at home, and all together are those of one process.

#include "Support/SkeletonShapes.h"
#include "Support/ThreadRanks.h"

#include "Targets/SharedFits.h"

#include <gtest/gtest.h>

#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

using namespace activesurface;

namespace
{

using Particles = std::vector<SkeletonVertex>;

constexpr double Spacing = 0.1;

// A body, a sheet, drops far away, several in one place, some that add nothing; of any radii.
Particles MakeParticles(ParticleModel model, double largest)
{
  Random random(5);
  Particles particles;
  const double usual = GetReachPerSpacing(model) * Spacing;
  const auto add = [&](const Point& x, double strength) {
    particles.push_back({ { x[0], x[1], x[2] }, usual * random.Between(0.8, 1.3), strength });
  };
  for (int i = 0; i < 4000; ++i)
  {
    const double flat = i % 4 == 0 ? 0.02 : 0.3;
    add({ random.Between(-1.0, 1.0), random.Between(-0.3, 0.3), random.Between(-flat, flat) },
      i % 97 == 0 ? -1.0 : random.Between(0.5, 1.0));
  }
  for (int i = 0; i < 20; ++i)
  {
    add({ 1e6 * i, 3.0 + i, -1e12 }, 1.0);
    add({ 0.5, 0.25, 0.0 }, 1.0);
  }
  particles.push_back({ { 0.1, 0.0, 0.2 }, largest * usual, 1.0 });
  return particles;
}

bool AreSame(const ParticleFit& a, const ParticleFit& b)
{
  return std::memcmp(&a, &b, sizeof a) == 0;
}

// Each rank asks for all, and for every third in another order.
void CheckOnRanks(
  const FitOptions& options, const Particles& particles, int size, const std::string& name)
{
  const ParticleFits alone = FitParticles(options, particles);
  std::vector<std::size_t> atHome(static_cast<std::size_t>(size));
  std::vector<std::size_t> different(atHome.size());
  RunOnRanks(size,
    [&](Agreement& ranks)
    {
      const SharedFits shared(ranks, options, particles);
      const auto rank = static_cast<std::size_t>(ranks.GetRank());
      atHome[rank] = shared.GetAtHome().size();
      std::vector<std::size_t> numbers;
      for (std::size_t i = 0; i < particles.size(); ++i)
      {
        numbers.push_back(i);
      }
      for (std::size_t i = particles.size(); i >= 3; i -= 3)
      {
        numbers.push_back(i - 1);
      }
      const ParticleFits fetched = shared.Fetch(particles, numbers, shared.GetAtHome());
      for (std::size_t n = 0; n < numbers.size(); ++n)
      {
        different[rank] += AreSame(fetched[n], alone[numbers[n]]) ? 0 : 1;
      }
    });
  std::size_t sum = 0;
  for (std::size_t rank = 0; rank < atHome.size(); ++rank)
  {
    EXPECT_EQ(different[rank], 0u) << name << ", rank " << rank;
    sum += atHome[rank];
  }
  EXPECT_EQ(sum, particles.size()) << "each is at home once, " << name;
}

}

TEST(TestSharedFits, AreThoseOfOneProcess)
{
  for (const ParticleModel model :
    { ParticleModel::Sum, ParticleModel::AveragedCentre, ParticleModel::Anisotropic })
  {
    for (const double largest : { 1.0, 40.0 })
    {
      for (const int size : { 2, 3, 5 })
      {
        FitOptions options;
        options.Model = model;
        const std::string name = "model " + std::to_string(static_cast<int>(model)) + ", largest " +
          std::to_string(largest) + ", " + std::to_string(size) + " ranks";
        CheckOnRanks(options, MakeParticles(model, largest), size, name);
        options.OwnRadius = 0.6 * Spacing;
        CheckOnRanks(options, MakeParticles(model, largest), size, name + ", of one own radius");
      }
    }
  }
}

TEST(TestSharedFits, FewParticlesAndNone)
{
  const FitOptions options;
  CheckOnRanks(options, {}, 3, "none");
  CheckOnRanks(options, { { { 1e30, 0.0, -1e30 }, 0.3, 1.0 } }, 3, "one");
}

// One rank asks for more than there are in a round, the others for few.
TEST(TestSharedFits, AreFetchedInRounds)
{
  const Particles particles = MakeParticles(ParticleModel::Anisotropic, 1.0);
  FitOptions options;
  options.Model = ParticleModel::Anisotropic;
  const ParticleFits alone = FitParticles(options, particles);
  RunOnRanks(3,
    [&](Agreement& ranks)
    {
      const SharedFits shared(ranks, options, particles);
      const std::size_t count = ranks.GetRank() == 1 ? 140000 : 5;
      std::vector<std::size_t> numbers;
      for (std::size_t n = 0; n < count; ++n)
      {
        numbers.push_back(n * 7 % particles.size());
      }
      const ParticleFits fetched = shared.Fetch(particles, numbers, shared.GetAtHome());
      std::size_t different = 0;
      for (std::size_t n = 0; n < count; ++n)
      {
        different += AreSame(fetched.at(n), alone[numbers[n]]) ? 0 : 1;
      }
      EXPECT_EQ(different, 0u);
    });
}

// All ranks come to the same end, also those that have none of them at home.
TEST(TestSharedFits, CrowdsAreRefusedOnAllRanks)
{
  const Particles particles(40000, { { 0.1, 0.2, 0.3 }, 0.3, 1.0 });
  RunOnRanks(3,
    [&](Agreement& ranks)
    {
      FitOptions options;
      EXPECT_THROW(SharedFits(ranks, options, particles), std::invalid_argument);
      options.SparesCrowds = true;
      const SharedFits spared(ranks, options, particles);
      EXPECT_EQ(spared.GetAtHome().size(), spared.GetHomes().GetNumbers().size());
    });
}

// A body is shared evenly.
TEST(TestSharedFits, HomesHaveAboutAsManyParticles)
{
  Random random(2);
  Particles particles;
  for (int i = 0; i < 20000; ++i)
  {
    particles.push_back(
      { { random.Between(-1.0, 1.0), random.Between(-1.0, 1.0), random.Between(-1.0, 1.0) }, 0.1,
        1.0 });
  }
  constexpr int size = 4;
  RunOnRanks(size,
    [&](Agreement& ranks)
    {
      const ParticleHomes homes(ranks, particles, 1.0);
      std::size_t own = 0;
      for (const SkeletonVertex& particle : particles)
      {
        own += homes.IsAtHome(particle.Position) ? 1 : 0;
      }
      EXPECT_NEAR(double(own), double(particles.size()) / size, 0.02 * double(particles.size()));
    });
}
