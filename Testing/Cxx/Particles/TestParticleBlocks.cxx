// Particles whose supports may touch a box, found by their blocks.

#include "Support/SkeletonShapes.h"

#include "Nodes/ParticleBlocks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

using namespace activesurface;

namespace TestParticleBlocks
{

namespace
{

constexpr double SupportPerRadius = 5.0;

class Cubes final : public ParticleCubes
{
public:
  void Add(double x, double y, double z, double radius)
  {
    this->All.push_back({ { x, y, z }, radius, 2.0 * radius, 1.0 });
  }
  std::size_t Size() const override { return this->All.size(); }
  ParticleCube Get(std::size_t n) const override { return this->All[n]; }

private:
  std::vector<ParticleCube> All;
};

// Particles with radii from 0.5 to 1 beside one with the radius `ratio`.
Cubes MakeMixed(int count, double ratio)
{
  Random random(11);
  Cubes cubes;
  for (int n = 0; n < count; ++n)
  {
    cubes.Add(random.Between(-30.0, 30.0), random.Between(-30.0, 30.0), random.Between(-30.0, 30.0),
      random.Between(0.5, 1.0));
  }
  cubes.Add(30.0 + ratio, 0.0, 0.0, ratio);
  return cubes;
}

class MixedParticles
{
public:
  MixedParticles(int count, double ratio)
    : Given(MakeMixed(count, ratio))
  {
    this->Blocks.Build(this->Given, { 1.0, SupportPerRadius, true });
    this->Blocks.FindReaches(
      [this](std::uint32_t k) { return SupportPerRadius * this->Get(k).HalfSide; }, this->Reaches);
  }

  ParticleCube Get(std::uint32_t k) const { return this->Given.Get(this->Blocks.GetOrder()[k]); }

  // Returns the particles found around a cube of eight voxels, in their order.
  std::vector<std::uint32_t> Visit(const double (&low)[3]) const
  {
    const double high[3] = { low[0] + 8.0, low[1] + 8.0, low[2] + 8.0 };
    std::vector<std::uint32_t> found;
    this->Blocks.VisitRuns(low, high, this->Reaches,
      [&](std::uint32_t first, std::uint32_t end, const NodeIndex&)
      {
        for (std::uint32_t k = first; k < end; ++k)
        {
          found.push_back(k);
        }
      });
    return found;
  }

  bool Touches(std::uint32_t k, const double (&low)[3]) const
  {
    const ParticleCube cube = this->Get(k);
    for (int axis = 0; axis < 3; ++axis)
    {
      const double beyond =
        std::max(low[axis] - cube.Position[axis], cube.Position[axis] - low[axis] - 8.0);
      if (beyond >= SupportPerRadius * cube.HalfSide)
      {
        return false;
      }
    }
    return true;
  }

  std::size_t Size() const { return this->Given.Size(); }

private:
  const Cubes Given;
  ParticleBlocks Blocks;
  ParticleBlocks::Reaches Reaches;
};

void CheckAllAreFound(double ratio)
{
  const MixedParticles mixed(2000, ratio);
  Random random(5);
  for (int n = 0; n < 100; ++n)
  {
    double low[3];
    for (double& place : low)
    {
      place = random.Between(-60.0, 60.0);
    }
    const std::vector<std::uint32_t> found = mixed.Visit(low);
    const std::set<std::uint32_t> all(found.begin(), found.end());
    ASSERT_EQ(all.size(), found.size()) << "a particle is found twice";
    for (std::uint32_t k = 0; k < mixed.Size(); ++k)
    {
      ASSERT_TRUE(all.count(k) || !mixed.Touches(k, low))
        << "ratio " << ratio << ", particle " << k;
    }
  }
}

}

TEST(TestParticleBlocks, AllParticlesThatTouchABoxAreFound)
{
  for (const double ratio : { 1.0, 3.0, 20.0, 300.0 })
  {
    CheckAllAreFound(ratio);
  }
}

// If a large particle brought the small ones, each leaf would visit all particles within the
// support of the largest.
TEST(TestParticleBlocks, OneLargeParticleDoesNotBringTheSmallOnes)
{
  const MixedParticles mixed(20000, 20.0);
  const double middle[3] = { 0.0, 0.0, 0.0 };
  EXPECT_LT(mixed.Visit(middle).size(), mixed.Size() / 8);
  const double atLarge[3] = { 60.0, 0.0, 0.0 };
  EXPECT_LT(mixed.Visit(atLarge).size(), mixed.Size() / 20);
}

}
