// Weighted tension: the target says how much of Tension there is at each point of the surface.

#include "NarrowBandGrid.h"
#include "Support/SurfaceMeasures.h"
#include "Support/Throws.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

using namespace activesurface;

namespace TestWeightedTension
{
const double H = VoxelSizeOf(64);

using Weight = std::function<double(const Point&)>;

Weight Constant(double weight)
{
  return [weight](const Point&) { return weight; };
}

// Bumps of .6 voxels, ten voxels long.
Shape MakeBumpyBall(const Weight& weight)
{
  const auto value = [](const Point& x)
  {
    constexpr double wave = 20.0;
    const double bumps = std::sin(wave * x[1]) * std::sin(wave * x[2]);
    return std::hypot(x[0], x[1], x[2]) - 0.6 - 0.02 * bumps;
  };
  return { value, {}, nullptr, weight };
}

Motion MakeWeighted(double attraction, double tension)
{
  Motion motion = MakeMotion(attraction, tension);
  motion.WeightedTension = true;
  return motion;
}

std::unique_ptr<NarrowBand> Play(const Shape& shape, const Motion& motion, double time)
{
  auto band = std::make_unique<NarrowBand>(H);
  StartOn(*band, shape);
  ShapeTarget target(shape);
  band->Advance(time, motion, target);
  return band;
}

TEST(TestWeightedTension, AWeightOfOneIsNone)
{
  for (const double attraction : { 0.0, 2.0 })
  {
    for (const TargetEvaluation evaluation : { TargetEvaluation::Shifted, TargetEvaluation::Node })
    {
      Motion weighted = MakeWeighted(attraction, 0.05);
      weighted.Evaluation = evaluation;
      weighted.Integration =
        evaluation == TargetEvaluation::Shifted ? weighted.Integration : TimeIntegration::Explicit;
      Motion plain = weighted;
      plain.WeightedTension = false;
      const auto one = Play(MakeBumpyBall(nullptr), plain, 0.05);
      EXPECT_TRUE(AreIdentical(*one, *Play(MakeBumpyBall(Constant(1.0)), weighted, 0.05)))
        << "the same potential, Attraction " << attraction;
      EXPECT_FALSE(AreIdentical(*one, *Play(MakeBumpyBall(Constant(0.5)), weighted, 0.05)))
        << "another weight makes a difference, Attraction " << attraction;
    }
  }
}

using Node = std::pair<openvdb::Coord, float>;

// The active nodes for which is(x), x in voxels.
std::vector<Node> GetNodes(const NarrowBand& band, const std::function<bool(int)>& is)
{
  std::vector<Node> nodes;
  for (auto node = GetPotential(band)->cbeginValueOn(); node; ++node)
  {
    if (is(node.getCoord()[0]))
    {
      nodes.emplace_back(node.getCoord(), *node);
    }
  }
  return nodes;
}

// Values at nodes are those of neighbours one voxel off, extended weights come from three off at
// most, ghosts from four: ten voxels from the seam nothing of it has come after one substep.
TEST(TestWeightedTension, EachHalfHasItsOwn)
{
  const Weight half = [](const Point& x) { return x[0] < 0.0 ? 0.0 : 1.0; };
  const Shape start = MakeBumpyBall(half);
  const double substep = 0.25 * H * H; // at a Tension of 1
  const Motion weighted = MakeWeighted(0.0, 1.0);
  const auto before = Play(start, weighted, 0.0);
  const auto once = Play(start, weighted, substep);
  const auto plain = Play(start, MakeMotion(0.0, 1.0), substep);
  const auto isFarRight = [](int x) { return x > 10; };
  EXPECT_GT(GetNodes(*once, isFarRight).size(), 1000u) << "nodes to compare";
  EXPECT_TRUE(GetNodes(*once, isFarRight) == GetNodes(*plain, isFarRight))
    << "where the weight is 1, the same to the bit as without weights";
  EXPECT_FALSE(GetNodes(*once, isFarRight) == GetNodes(*before, isFarRight)) << "and it moves";

  const auto isLeft = [](int x) { return x < -4; };
  const auto later = Play(start, weighted, 40.0 * substep);
  EXPECT_GT(GetNodes(*later, isLeft).size(), 1000u) << "nodes to compare";
  EXPECT_TRUE(GetNodes(*later, isLeft) == GetNodes(*before, isLeft))
    << "where the weight is 0, the same to the bit as at the start";
}

/** Of the vertices around one end of the x axis. */
Range GetRadiiOfCap(const Mesh& mesh, double side)
{
  Mesh half;
  for (std::size_t i = 0; i < mesh.Points.size(); i += 3)
  {
    if (side * mesh.Points[i] > 0.45)
    {
      half.Points.insert(half.Points.end(), &mesh.Points[i], &mesh.Points[i] + 3);
    }
  }
  return GetRadii(half, { 0.0, 0.0, 0.0 });
}

// Along the surface the waves of 20 in y and z have a square of 2 * 20^2 less what is along the
// normal, 450 at the rim of the cap; under tension they decay by exp(-450 * .01) there at least.
// The ball shrinks, but alike everywhere; of the seam, .45 off, exp(-.45^2 / .04) has come.
TEST(TestWeightedTension, BumpsStayWhereTheWeightIsNone)
{
  const Weight half = [](const Point& x) { return x[0] < 0.0 ? 0.0 : 1.0; };
  const Shape start = MakeBumpyBall(half);
  const Motion motion = MakeWeighted(0.0, 1.0);
  const Mesh before = Polygonise(*Play(start, motion, 0.0));
  const Mesh after = Polygonise(*Play(start, motion, 0.01));
  EXPECT_EQ(GetRadiiOfCap(after, -1.0).GetSpread(), GetRadiiOfCap(before, -1.0).GetSpread())
    << "spread of the radii where the weight is 0";
  EXPECT_LT(GetRadiiOfCap(after, 1.0).GetSpread(), 0.2 * GetRadiiOfCap(before, 1.0).GetSpread())
    << "spread of the radii where it is 1";
}

// At rest Attraction (R - r) = 2 w Tension / r. Tolerance of the rest under tension, TestRest.
TEST(TestWeightedTension, RestIsTheBalanceWithTheWeightedTension)
{
  for (const double weight : { 0.0, 0.25, 1.0 })
  {
    Shape ball = MakeBall(CentreA, 0.6);
    ball.TensionWeight = Constant(weight);
    const Motion motion = MakeWeighted(5.0, 0.05);
    NarrowBand band(H);
    StartOn(band, ball);
    ShapeTarget target(ball);
    band.Advance(4.0, motion, target);
    const double exact = 0.3 + std::sqrt(0.09 - 2.0 * weight * 0.05 / 5.0);
    const std::string name = "weight " + std::to_string(weight);
    const Range radii = GetRadii(Polygonise(band), CentreA);
    EXPECT_NEAR((radii.Mean - exact) / H, 0.0, 0.04) << "error of the mean radius [h], " << name;
    EXPECT_EQ(band.Advance(5.0, motion, target).Substeps, 0u) << "it has converged, " << name;
  }
}

TEST(TestWeightedTension, WrongWeightsCountAsTheNearestOnes)
{
  const auto run = [](double weight)
  { return Play(MakeBumpyBall(Constant(weight)), MakeWeighted(1.0, 0.05), 0.02); };
  constexpr double infinity = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(AreIdentical(*run(7.0), *run(1.0))) << "more than 1 is 1";
  EXPECT_TRUE(AreIdentical(*run(infinity), *run(1.0))) << "more than 1 is 1";
  EXPECT_TRUE(AreIdentical(*run(-7.0), *run(0.0))) << "less than 0 is 0";
  EXPECT_TRUE(AreIdentical(*run(std::nan("")), *run(1.0))) << "what is no number is 1";
}

TEST(TestWeightedTension, ThePapersSchemeHasNone)
{
  NarrowBand band(H);
  StartOn(band, MakeBall(CentreA, 0.3));
  ShapeTarget target(MakeBall(CentreA, 0.3));
  Motion motion = MakeWeighted(1.0, 0.1);
  motion.Paper = true;
  EXPECT_TRUE(Throws<std::invalid_argument>(
    [&] { band.Advance(1.0, motion, target); }, "neither Transport nor WeightedTension"));
}
}
