// Particles that ranks send each other: nothing is lost, and they come in the order of a frame.

#include "Frames/ParticleBytes.h"
#include "Frames/ParticleOrder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

using namespace activesurface;

namespace TestParticleBytes
{

namespace
{

struct Kind
{
  bool AreSingle, HaveStrengths, HaveVelocities, HaveIds;
};

ParticleFrame MakeFrame(std::size_t count, const Kind& kind)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> side(-1.0, 1.0);
  ParticleFrame frame;
  frame.HasIds = kind.HaveIds;
  frame.HasVelocities = kind.HaveVelocities;
  frame.Particles.Reserve(count, kind.AreSingle);
  for (std::size_t i = 0; i < count; ++i)
  {
    SkeletonVertex particle;
    for (double& place : particle.Position)
    {
      const double drawn = side(random);
      place = kind.AreSingle ? static_cast<double>(static_cast<float>(drawn)) : drawn;
    }
    particle.Position[0] += kind.HaveIds ? 0.0 : 4.0 * static_cast<double>(i); // in order
    particle.Radius = 1.0;
    particle.Strength = kind.HaveStrengths ? 0.25 + 0.5 * side(random) : 1.0;
    frame.Particles.Add(particle);
    frame.Ids.push_back(static_cast<std::int64_t>(3 * i));
    if (kind.HaveVelocities)
    {
      frame.Velocities.push_back({ side(random), side(random), side(random) });
    }
  }
  frame.GiveRadius(0.7);
  return frame;
}

void ExpectSame(const ParticleFrame& found, const ParticleFrame& expected)
{
  ASSERT_EQ(found.Particles.size(), expected.Particles.size());
  EXPECT_EQ(found.Ids, expected.Ids);
  EXPECT_EQ(found.HasIds, expected.HasIds);
  EXPECT_EQ(found.Velocities, expected.Velocities);
  EXPECT_EQ(found.HasVelocities, expected.HasVelocities);
  for (std::size_t i = 0; i < expected.Particles.size(); ++i)
  {
    const SkeletonVertex a = found.Particles[i], b = expected.Particles[i];
    EXPECT_TRUE(std::equal(a.Position, a.Position + 3, b.Position)) << "place of " << i;
    EXPECT_EQ(a.Radius, b.Radius);
    EXPECT_EQ(a.Strength, b.Strength);
  }
}

}

TEST(TestParticleBytes, MergedPartsAreTheWhole)
{
  const Kind kinds[] = { { true, false, false, true }, { false, true, false, true },
    { true, true, true, false }, { false, false, true, false } };
  for (const Kind& kind : kinds)
  {
    constexpr std::size_t count = 500, ranks = 5;
    const ParticleFrame whole = MakeFrame(count, kind);
    std::vector<ParticleChoice> chosen(ranks);
    std::mt19937 random(9);
    for (std::uint32_t i = 0; i < count; ++i)
    {
      chosen[random() % (ranks - 1)].push_back(i); // the last rank gets none
    }
    // The bytes contain the given strengths, because another model has another limit.
    ParticleFrame limited = whole;
    EXPECT_TRUE(limited.Particles.LimitStrengths(0.3));
    EXPECT_LE(limited.Particles[0].Strength, 0.3);
    std::vector<Bytes> parts;
    for (const ParticleChoice& ofRank : chosen)
    {
      parts.push_back(PackParticles(limited, ofRank));
    }
    EXPECT_TRUE(parts.back().empty());
    const ParticleFrame merged = MergeParticles(parts, whole);
    EXPECT_EQ(merged.Particles.AreSingle(), whole.Particles.AreSingle());
    ExpectSame(merged, whole);
  }
}

TEST(TestParticleBytes, NothingIsAnEmptyFrameOfTheSameKind)
{
  const ParticleFrame like = MakeFrame(3, { true, false, true, true });
  const ParticleFrame none = MergeParticles({ {}, {} }, like);
  EXPECT_TRUE(none.Particles.empty());
  EXPECT_TRUE(none.HasIds);
  EXPECT_TRUE(none.HasVelocities);
  EXPECT_EQ(none.Particles.GetCommonRadius(), 0.7);
}

// Few runs are merged, many are sorted: the order is the same.
TEST(TestParticleBytes, TheOrderOfRunsIsThatOfSorting)
{
  for (const std::size_t runs : { 1u, 2u, 7u, 63u, 64u, 200u })
  {
    ParticleList particles;
    std::vector<std::int64_t> ids;
    for (std::size_t run = 0; run < runs; ++run)
    {
      for (std::int64_t i = 0; i < 20; ++i)
      {
        ids.push_back(i * static_cast<std::int64_t>(run % 3 + 1)); // some of them equal
        SkeletonVertex particle;
        particle.Position[0] = particle.Position[1] = particle.Position[2] = 0.0;
        particle.Radius = particle.Strength = 1.0;
        particles.Add(particle);
      }
    }
    std::vector<std::size_t> expected(ids.size());
    for (std::size_t i = 0; i < expected.size(); ++i)
    {
      expected[i] = i;
    }
    std::stable_sort(expected.begin(), expected.end(),
      [&ids](std::size_t a, std::size_t b) { return ids[a] < ids[b]; });
    const std::vector<std::size_t> found = FindParticleOrder(particles, &ids);
    EXPECT_EQ(found, runs == 1 ? std::vector<std::size_t>() : expected) << runs << " runs";
  }
}

}
