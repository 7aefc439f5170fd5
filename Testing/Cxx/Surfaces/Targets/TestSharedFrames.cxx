// Particles that ranks share: each has those at home, and all together are those of one process.

#include "Support/ParticleClouds.h"
#include "Support/SkeletonShapes.h"
#include "Support/ThreadRanks.h"

#include "Targets/ParticleSpacing.h"
#include "Targets/SharedMatches.h"

#include <gtest/gtest.h>

#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

using namespace activesurface;

namespace TestSharedFrames
{

namespace
{

constexpr double Spacing = 0.1;
const int Sizes[] = { 2, 3, 5 };

// A body, a sheet, drops far away, several in one place, some that add nothing; of any radii, in
// any order.
Cloud MakeCloud(ParticleModel model = ParticleModel::Anisotropic, double largest = 1.0)
{
  Random random(5);
  Cloud cloud;
  const double usual = GetReachPerSpacing(model) * Spacing;
  const auto add = [&](const Point& x, double strength)
  {
    const auto number = static_cast<std::int64_t>(cloud.Particles.size());
    cloud.Add(x[0], x[1], x[2], usual * random.Between(0.8, 1.3), strength, number * 1237 % 5003);
    cloud.Particles.back().Velocity = { x[1], double(number), random.Between(0.0, 1.0) };
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
  cloud.Add(0.1, 0.0, 0.2, largest * usual, 1.0, 5004);
  cloud.HasVelocities = true;
  return cloud;
}

// What is left out, and equal ones.
Cloud MakeOdd(bool hasIds)
{
  Cloud cloud = MakeCloud();
  cloud.HasIds = hasIds;
  cloud.IsPassed = true;
  for (std::size_t i = 0; i < cloud.Particles.size(); i += 5)
  {
    cloud.Particles[i].Id = 3;
    cloud.Particles[i].Vertex.Position[0] = 0.25;
  }
  cloud.Particles[11].Vertex.Radius = -1.0;
  cloud.Particles[3999].Vertex.Position[2] = NaN;
  return cloud;
}

template <class Value>
bool AreSame(const std::vector<Value>& a, const std::vector<Value>& b)
{
  return a.size() == b.size() &&
    (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Value)) == 0);
}

bool AreSame(const ParticleFit& a, const ParticleFit& b)
{
  return std::memcmp(&a, &b, sizeof a) == 0;
}

void CheckFrame(const ParticleFrame& whole, const ParticleFrame& shared, const std::string& name)
{
  const ParticleFrame all = GatherFrame(shared);
  EXPECT_EQ(shared.CountAll(), whole.Particles.size()) << name;
  EXPECT_EQ(shared.Ignored, whole.Ignored) << name;
  EXPECT_EQ(all.HasIds, whole.HasIds) << name;
  EXPECT_EQ(all.HasRadii, whole.HasRadii) << name;
  EXPECT_TRUE(AreSame(all.Particles, whole.Particles)) << name << ", particles";
  EXPECT_TRUE(AreSame(all.Ids, whole.Ids)) << name << ", ids";
  EXPECT_TRUE(AreSame(all.Velocities, whole.Velocities)) << name << ", velocities";
  double expected[6], bounds[6];
  EXPECT_EQ(shared.GetBounds(bounds), whole.GetBounds(expected)) << name;
  EXPECT_TRUE(std::equal(bounds, bounds + 6, expected)) << name << ", bounds";
  EXPECT_EQ(shared.Shared->LargestRadius, FindLargestRadius(whole.Particles)) << name;
  EXPECT_EQ(shared.Shared->LargestRadiusOfActive, FindLargestRadiusOfActive(whole.Particles))
    << name;
}

// The rows of the array that go with the particles; the points may be in another order.
std::vector<double> ListPassed(const ParticleFrame& frame)
{
  std::vector<double> rows;
  for (const vtkIdType point : frame.Points)
  {
    rows.push_back(frame.Passed->GetArray("number")->GetComponent(point, 0));
  }
  return rows;
}

}

TEST(TestSharedFrames, TogetherAreTheWhole)
{
  const Cloud clouds[] = { MakeCloud(), MakeOdd(true), MakeOdd(false), Cloud() };
  for (const Cloud& cloud : clouds)
  {
    const ParticleFrame whole = ReadCloud(cloud, nullptr);
    for (const int size : Sizes)
    {
      RunOnRanks(size,
        [&](Agreement& ranks)
        {
          const std::string name = std::to_string(size) + " ranks, " +
            std::to_string(cloud.Particles.size()) + " points, ids " + std::to_string(cloud.HasIds);
          const ParticleFrame shared = ReadCloudHome(cloud, &ranks);
          CheckFrame(whole, shared, name);
          for (const SkeletonVertex& particle : shared.Particles)
          {
            EXPECT_TRUE(shared.Shared->Homes->IsAtHome(particle.Position)) << name;
          }
          if (cloud.IsPassed)
          {
            EXPECT_EQ(ListPassed(GatherFrame(shared)), ListPassed(whole)) << name;
          }
        });
    }
  }
}

// More ranks than particles, too.
TEST(TestSharedFrames, HaveTheSpacingOfTheWhole)
{
  for (const std::size_t count : { 0, 1, 2, 3, 4, 7, 2500, 4041 })
  {
    Cloud cloud = MakeCloud();
    cloud.Particles.resize(count);
    const double spacing = FindSpacing(ReadCloud(cloud, nullptr));
    EXPECT_EQ(spacing > 0.0, count > 1);
    for (const int size : Sizes)
    {
      RunOnRanks(size,
        [&](Agreement& ranks)
        {
          const ParticleFrame shared = ReadCloud(cloud, &ranks);
          EXPECT_EQ(FindSpacing(shared), spacing) << count << " on " << size;
          EXPECT_EQ(FindSpacing(ReadCloudHome(cloud, &ranks)), spacing) << "at home, " << count;
          if (count > 0)
          {
            EXPECT_EQ(FindMedianRadius(shared), FindMedianRadius(ReadCloud(cloud, nullptr)));
          }
        });
    }
  }
}

namespace
{

// The partners, by their places in the order of all, and the births.
struct Matched
{
  std::vector<std::size_t> Partners;
  std::vector<std::size_t> Births;
};

void CheckMatches(const Cloud& before, const Cloud& after, const std::string& name)
{
  const ParticleFrame earlier = ReadCloud(before, nullptr), later = ReadCloud(after, nullptr);
  const ParticleMatches alone = MatchParticles(earlier, later);
  for (const int size : Sizes)
  {
    RunOnRanks(size,
      [&](Agreement& ranks)
      {
        const ParticleFrame from = ReadCloudHome(before, &ranks), to = ReadCloudHome(after, &ranks);
        const ParticleMatches matches = MatchSharedParticles(from, to);
        const std::string which = name + ", " + std::to_string(size) + " ranks";
        EXPECT_EQ(matches.AreShuffled, alone.AreShuffled) << which;
        EXPECT_EQ(FindLongestWay(from, to, matches), FindLongestWay(earlier, later, alone))
          << which;
        std::size_t different = 0;
        for (std::size_t i = 0; i < from.Particles.size(); ++i)
        {
          const std::size_t expected = alone.Partners[from.Shared->Numbers[i]];
          different += matches.Partners[i] != expected;
          different += expected != NoPartner &&
            std::memcmp(&matches.Ends[i], &later.Particles[expected], sizeof(SkeletonVertex)) != 0;
        }
        EXPECT_EQ(different, 0u) << which;
        std::vector<std::size_t> births;
        for (const std::size_t birth : matches.Births)
        {
          births.push_back(to.Shared->Numbers[birth]);
        }
        births = GatherLists(ranks, births);
        std::sort(births.begin(), births.end());
        EXPECT_EQ(births, alone.Births) << which;
      });
  }
}

// Some are not there at the other step, all have moved.
Cloud MakeLater(const Cloud& cloud, int leftOut, double way)
{
  Cloud later = cloud;
  later.Particles.clear();
  for (std::size_t i = 0; i < cloud.Particles.size(); ++i)
  {
    CloudParticle particle = cloud.Particles[cloud.HasIds ? cloud.Particles.size() - 1 - i : i];
    particle.Vertex.Position[1] += way;
    if (leftOut == 0 || i % static_cast<std::size_t>(leftOut) != 0)
    {
      later.Particles.push_back(particle);
    }
  }
  return later;
}

}

TEST(TestSharedFrames, AreMatchedAsTheWhole)
{
  const Cloud cloud = MakeCloud();
  CheckMatches(MakeLater(cloud, 7, 0.0), MakeLater(cloud, 5, 0.1), "births and deaths");
  CheckMatches(MakeOdd(true), MakeLater(MakeOdd(true), 3, 0.2), "equal ids");
  CheckMatches(MakeOdd(false), MakeLater(MakeOdd(false), 0, 0.2), "by number");
  CheckMatches(MakeOdd(false), MakeLater(MakeOdd(false), 9, 0.2), "other counts");
  CheckMatches(cloud, MakeOdd(false), "ids in one step alone");
  Cloud shuffled = MakeOdd(false);
  for (CloudParticle& particle : shuffled.Particles)
  {
    for (double& x : particle.Vertex.Position)
    {
      x = -x;
    }
  }
  CheckMatches(MakeOdd(false), shuffled, "by number, across the cloud");
  CheckMatches(Cloud(), cloud, "all are born");
}

namespace
{

void CheckFits(const FitOptions& options, const Cloud& cloud, int size, const std::string& name)
{
  ParticleFrame alone = ReadCloud(cloud, nullptr);
  alone.FindFits(options);
  std::vector<std::size_t> atHome(static_cast<std::size_t>(size));
  std::vector<std::size_t> different(atHome.size());
  RunOnRanks(size,
    [&](Agreement& ranks)
    {
      ParticleFrame shared = ReadCloudHome(cloud, &ranks, options.Model);
      shared.FindFits(options);
      const auto rank = static_cast<std::size_t>(ranks.GetRank());
      atHome[rank] = shared.Fits.size();
      for (std::size_t n = 0; n < shared.Fits.size(); ++n)
      {
        const std::size_t number = shared.Shared->Numbers[n];
        different[rank] += AreSame(shared.Fits[n], alone.Fits[number]) ? 0 : 1;
      }
    });
  std::size_t sum = 0;
  for (std::size_t rank = 0; rank < atHome.size(); ++rank)
  {
    EXPECT_EQ(different[rank], 0u) << name << ", rank " << rank;
    sum += atHome[rank];
  }
  EXPECT_EQ(sum, cloud.Particles.size()) << "each is at home once, " << name;
}

}

TEST(TestSharedFrames, HaveTheFitsOfTheWhole)
{
  for (const ParticleModel model :
    { ParticleModel::Sum, ParticleModel::AveragedCentre, ParticleModel::Anisotropic })
  {
    for (const double largest : { 1.0, 40.0 })
    {
      for (const int size : Sizes)
      {
        FitOptions options;
        options.Model = model;
        const std::string name = "model " + std::to_string(static_cast<int>(model)) + ", largest " +
          std::to_string(largest) + ", " + std::to_string(size) + " ranks";
        CheckFits(options, MakeCloud(model, largest), size, name);
        options.OwnRadius = 0.6 * Spacing;
        CheckFits(options, MakeCloud(model, largest), size, name + ", of one own radius");
      }
    }
  }
}

TEST(TestSharedFrames, HaveFitsOfFewParticlesAndNone)
{
  CheckFits(FitOptions(), Cloud(), 3, "none");
  Cloud one;
  one.Add(1e30, 0.0, -1e30, 0.3, 1.0, 7);
  CheckFits(FitOptions(), one, 3, "one");
}

// All ranks come to the same end, also those that have none of them at home.
TEST(TestSharedFrames, CrowdsAreRefusedOnAllRanks)
{
  Cloud crowd;
  for (int i = 0; i < 40000; ++i)
  {
    crowd.Add(0.1, 0.2, 0.3, 0.3, 1.0, i);
  }
  RunOnRanks(3,
    [&](Agreement& ranks)
    {
      FitOptions options;
      ParticleFrame frame = ReadCloudHome(crowd, &ranks, options.Model);
      EXPECT_THROW(frame.FindFits(options), std::invalid_argument);
      options.SparesCrowds = true;
      frame.FindFits(options);
      EXPECT_EQ(frame.Fits.size(), frame.Particles.size());
    });
}

// However the input has them.
TEST(TestSharedFrames, HomesHaveAboutAsManyParticles)
{
  Random random(2);
  Cloud cloud;
  for (int i = 0; i < 20000; ++i)
  {
    const Point x = random.In(-1.0, 1.0);
    cloud.Add(x[0], x[1], x[2], 0.1, 1.0, i);
  }
  constexpr int size = 4;
  RunOnRanks(size,
    [&](Agreement& ranks)
    {
      std::vector<std::size_t> all(cloud.Particles.size());
      for (std::size_t i = 0; i < all.size(); ++i)
      {
        all[i] = i;
      }
      ParticleFrame frame =
        ReadCloud(cloud, ranks.GetRank() == 1 ? all : std::vector<std::size_t>(), &ranks);
      BringHome(1.0, frame);
      const double count = static_cast<double>(cloud.Particles.size());
      EXPECT_NEAR(double(frame.Particles.size()), count / size, 0.02 * count);
    });
}

}
