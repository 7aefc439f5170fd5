// Parts of the target that the skin cannot reach, and hollows deep inside the skin, get a skin.

#include "Support/RandomShapes.h"
#include "Support/RegionTargets.h"

#include "NarrowBandGrid.h"
#include "Surface/SkinEvents.h"
#include "Surface/SkinParts.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

using namespace activesurface;
using namespace activesurface::twoballs;

namespace TestNewParts
{
/** Vertices with a larger x than this one. */
Mesh VerticesBeyond(const Mesh& mesh, double x)
{
  Mesh half;
  for (std::size_t i = 0; i < mesh.Points.size(); i += 3)
  {
    if (mesh.Points[i] > x)
    {
      half.Points.insert(half.Points.end(), &mesh.Points[i], &mesh.Points[i] + 3);
    }
  }
  return half;
}

/** Number of leaves of the first band that differ in the second one. */
std::size_t CountOtherLeaves(const NarrowBand& first, const NarrowBand& second)
{
  std::size_t count = 0;
  for (auto leaf = GetPotential(first)->tree().cbeginLeaf(); leaf; ++leaf)
  {
    const auto* other = GetPotential(second)->tree().probeConstLeaf(leaf->origin());
    count += !other || other->getValueMask() != leaf->getValueMask() ||
      std::memcmp(other->buffer().data(), leaf->buffer().data(), 512 * sizeof(float)) != 0;
  }
  return count;
}

// Linear crossings of a ball's distance are off by up to h / 8 r = 0.03 voxel.
TEST(TestNewParts, FarBallGetsItsSkinInTheSameSubstep)
{
  // The balls are 19 voxels apart: five layers and the remainders of two leaves do not meet.
  const Ball start = { { -0.6, 0.013, 0.007 }, 0.2 }, larger = { start.Centre, 0.25 };
  const Ball other = { { 0.6, 0.021, -0.013 }, 0.2 };
  RegionTarget target = MakeStandingBalls({ larger, other });
  const auto with = StartWith(MakeBalls({ start })), without = StartWith(MakeBalls({ start }));
  const std::vector<SkinPart> before = FindSkinParts(*with);
  const AdvanceReport report = with->Advance(1e-3, MakeCreating(), target);
  EXPECT_EQ(report.Substeps, 1u);
  EXPECT_EQ(report.CreatedParts, 1u);
  EXPECT_EQ(with->GetWork().CreatedParts, 1u);
  CheckSound(*with, { 2, 0, 4 });
  const Range radii = GetRadii(VerticesBeyond(Polygonise(*with), 0.0), other.Centre);
  EXPECT_NEAR((radii.Minimum - other.Radius) / H, 0.0, 0.04);
  EXPECT_NEAR((radii.Maximum - other.Radius) / H, 0.0, 0.04);
  EXPECT_EQ(FindEvents(before, FindSkinParts(*with)), "birth");
  Motion still = MakeCreating();
  still.CreateParts = false;
  EXPECT_EQ(without->Advance(1e-3, still, target).CreatedParts, 0u);
  EXPECT_EQ(CountOtherLeaves(*without, *with), 0u) << "the other ball does not see it";
  EXPECT_GT(CountOtherLeaves(*with, *without), 0u);
}

// The part appears when the ball contains a node, which is at most 0.87 voxel from the centre. The
// radius grows by 0.1 voxel per substep. The first crossings are within a voxel of this node.
TEST(TestNewParts, GrowingBallBeginsSmallAndFollows)
{
  constexpr double speed = 0.2;
  RegionTarget target = MakeMovingBalls(
    [](double time) {
      return std::vector<Ball>{ Left, { Right.Centre, std::max(speed * time, 1e-6) } };
    });
  const auto band = StartWith(MakeBalls({ Left }));
  Motion motion = MakeCreating(100.0);
  motion.LongestStep = 0.1 * H / speed;
  std::size_t created = 0;
  double radius = 0.0;
  for (int step = 1; step <= 60; ++step)
  {
    const double time = step * motion.LongestStep;
    const std::size_t now = band->Advance(time, motion, target).CreatedParts;
    const Mesh mesh = VerticesBeyond(Polygonise(*band), 0.0);
    if (now > 0)
    {
      EXPECT_LE(GetRadii(mesh, Right.Centre).Maximum, 2.0 * H) << "small at first";
      EXPECT_LE(speed * time, 1.1 * H);
    }
    EXPECT_EQ(mesh.GetNumberOfPoints() > 0, created + now > 0);
    created += now;
    radius = speed * time;
  }
  EXPECT_EQ(created, 1u);
  // The skin lags by speed / Attraction = 0.05 voxel, and by one substep, 0.1 voxel.
  EXPECT_NEAR(
    (GetRadii(VerticesBeyond(Polygonise(*band), 0.0), Right.Centre).Mean - radius) / H, -0.1, 0.1);
  CheckSound(*band, { 2, 0, 4 });
}

TEST(TestNewParts, BallInsideTheSkinChangesNothing)
{
  const Ball small = { { Left.Centre[0] + 0.1, 0.05, 0.0 }, 0.1 };
  RegionTarget target = MakeStandingBalls({ Left, small });
  const auto with = StartWith(MakeBalls({ Left })), without = StartWith(MakeBalls({ Left }));
  Motion still = MakeCreating();
  EXPECT_EQ(with->Advance(0.1, still, target).CreatedParts, 0u);
  still.CreateParts = false;
  without->Advance(0.1, still, target);
  EXPECT_TRUE(AreIdentical(*with, *without));
}

TEST(TestNewParts, LagOfTheSkinIsNoPart)
{
  // The skin bridges four voxels by itself.
  const Ball larger = { Left.Centre, Left.Radius + 4.0 * H };
  RegionTarget target =
    MakeStanding(MakeBalls({ larger }), { RegionAround(larger, RegionSeeds::AllNodes) });
  const auto band = StartWith(MakeBalls({ Left }));
  EXPECT_EQ(band->Advance(0.5, MakeCreating(), target).CreatedParts, 0u);
  CheckSound(*band, { 1, 0, 2 });
}

TEST(TestNewParts, HollowOpensDeepInside)
{
  for (const RegionSeeds seeds :
    { RegionSeeds::AllNodes, RegionSeeds::Centre, RegionSeeds::HollowAtCentre })
  {
    constexpr double outer = 0.7, inner = 0.3;
    const Shape shell = Move(MakeShell(outer, inner), CentreA);
    RegionTarget target = MakeStanding(shell, { RegionAround({ CentreA, inner }, seeds) });
    const auto band = StartWith(MakeBalls({ { CentreA, outer } }));
    EXPECT_EQ(band->Advance(1e-3, MakeCreating(), target).CreatedParts, 1u);
    CheckSound(*band, { 1, 1, 4 });
    constexpr double pi = 3.14159265358979323846;
    const double exact = 4.0 / 3.0 * pi * inner * inner * inner;
    for (const SkinPart& part : FindSkinParts(*band))
    {
      if (part.IsVoid())
      {
        // The error is second order in h / r: 0.18 % at r = 18.9 h (TestSphere), here r = 7.05 h.
        EXPECT_NEAR(-part.Volume / exact, 1.0, 0.0018 * 18.9 * 18.9 * H * H / (inner * inner));
      }
    }
    EXPECT_EQ(band->Advance(0.1, MakeCreating(), target).CreatedParts, 0u) << "once";
    CheckSound(*band, { 1, 1, 4 });
  }
}

// Tension closes hollows and balls of a target whose radius is below 2 sqrt 2 sqrt(Tension /
// Attraction).
TEST(TestNewParts, NarrowHollowStaysClosed)
{
  constexpr double outer = 0.7;
  Motion motion = MakeCreating();
  motion.Tension = 0.005;
  const double least = std::sqrt(8.0 * motion.Tension / motion.Attraction);
  for (const double inner : { 2.0 * H, 0.9 * least, 1.1 * least + H })
  {
    RegionTarget target = MakeStanding(Move(MakeShell(outer, inner), CentreA),
      { RegionAround({ CentreA, inner }, RegionSeeds::HollowAtCentre) });
    const auto band = StartWith(MakeBalls({ { CentreA, outer } }));
    EXPECT_EQ(band->Clone()->Advance(1e-3, motion, target).CreatedParts, inner > least ? 1u : 0u);
    EXPECT_EQ(band->Advance(1e-3, MakeCreating(), target).CreatedParts, 1u) << "without Tension";
  }
}

TEST(TestNewParts, PlaceOfAHollowMakesNoPart)
{
  RegionTarget target =
    MakeStanding(MakeBalls({ Left, Right }), { RegionAround(Right, RegionSeeds::HollowAtCentre) });
  const auto band = StartWith(MakeBalls({ Left }));
  EXPECT_EQ(band->Advance(1e-3, MakeCreating(), target).CreatedParts, 0u);
}

TEST(TestNewParts, NeighbourAtTwoVoxelsIsCreatedAndMergesWithoutSpecks)
{
  const Point centre = { Left.Centre[0] + Left.Radius + 2.0 * H + 0.2, 0.0, 0.0 };
  RegionTarget target = MakeMovingBalls(
    [&centre](double time)
    {
      const double growth = std::min(time, 1.0) * 3.0 * H;
      return std::vector<Ball>{ { Left.Centre, Left.Radius + growth }, { centre, 0.2 + growth } };
    });
  const auto band = StartWith(MakeBalls({ Left }));
  Motion motion = MakeCreating(10.0);
  motion.LongestStep = 0.02;
  EXPECT_EQ(band->Advance(1e-3, motion, target).CreatedParts, 1u);
  CheckSound(*band, { 2, 0, 4 });
  EXPECT_EQ(band->Advance(3.0, motion, target).CreatedParts, 0u);
  CheckSound(*band, { 1, 0, 2 });
}

struct Crowd
{
  std::vector<Ball> Balls;
  int Unions = 0;
};

/** Balls whose pairs overlap by at least half a radius or are at least three voxels apart. */
Crowd DrawCrowd(int count)
{
  RandomShapes random(912);
  Crowd crowd;
  std::vector<int> group;
  while (static_cast<int>(crowd.Balls.size()) < count)
  {
    const double x = random.DrawBetween(-0.85, 0.85), y = random.DrawBetween(-0.85, 0.85);
    const double z = random.DrawBetween(-0.85, 0.85);
    const Ball ball = { { x, y, z }, random.DrawBetween(1.8 * H, 2.4 * H) };
    std::vector<int> met;
    bool isClear = true;
    for (std::size_t i = 0; i < crowd.Balls.size() && isClear; ++i)
    {
      const Ball& other = crowd.Balls[i];
      const double gap = std::hypot(x - other.Centre[0], y - other.Centre[1], z - other.Centre[2]) -
        ball.Radius - other.Radius;
      isClear = gap < -0.5 * ball.Radius || gap > 3.0 * H;
      if (gap < 0.0)
      {
        met.push_back(group[i]);
      }
    }
    if (isClear)
    {
      const int own = static_cast<int>(group.size());
      for (int& g : group)
      {
        g = std::find(met.begin(), met.end(), g) != met.end() ? own : g;
      }
      group.push_back(own);
      crowd.Balls.push_back(ball);
    }
  }
  std::sort(group.begin(), group.end());
  crowd.Unions = static_cast<int>(std::unique(group.begin(), group.end()) - group.begin());
  return crowd;
}

std::unique_ptr<NarrowBand> FollowCrowd(const Crowd& crowd, bool isReversed, int threads)
{
  constexpr int substeps = 20;
  RegionTarget target = MakeMovingBalls(
    [&](double time)
    {
      const std::size_t count = std::min(crowd.Balls.size(),
        (static_cast<std::size_t>(time * substeps + 1e-6) + 1) * crowd.Balls.size() / substeps);
      std::vector<Ball> balls(
        crowd.Balls.begin(), crowd.Balls.begin() + static_cast<std::ptrdiff_t>(count));
      if (isReversed)
      {
        std::reverse(balls.begin(), balls.end());
      }
      return balls;
    });
  auto band = StartWith(MakeBalls({ crowd.Balls.front() }), threads);
  Motion motion = MakeCreating();
  motion.LongestStep = 1.0 / substeps;
  band->Advance(1.0, motion, target);
  // After twelve time constants, e^-12 of the distance remains.
  motion.LongestStep = std::numeric_limits<double>::infinity();
  band->Advance(13.0, motion, target);
  return band;
}

TEST(TestNewParts, CrowdOfBallsHasAsManyPartsAsUnions)
{
  const Crowd crowd = DrawCrowd(200);
  EXPECT_LT(crowd.Unions, 190) << "some overlap";
  EXPECT_GT(crowd.Unions, 20) << "some do not";
  // Four threads are used on machines with two cores too.
  const tbb::global_control fourThreads(tbb::global_control::max_allowed_parallelism, 4);
  const auto band = FollowCrowd(crowd, false, 1);
  const Mesh mesh = Polygonise(*band);
  const MeshDefects defects = FindDefects(mesh);
  EXPECT_EQ(defects.Edges + defects.Vertices + defects.Unused, 0u);
  EXPECT_EQ(GetTopology(mesh).Components, crowd.Unions);
  EXPECT_TRUE(AreIdentical(*band, *FollowCrowd(crowd, false, 4))) << "threads";
  EXPECT_TRUE(AreIdentical(*band, *FollowCrowd(crowd, true, 2))) << "order";
}

// The radius is 16 voxels. Leaves at the centre have no layer, and become tiles.
TEST(TestNewParts, LargePartIsInsideThroughout)
{
  const Ball large = { { 0.4, 0.0, 0.0 }, 16.0 * H / 2.0 };
  NarrowBand band(H / 2.0);
  StartOn(band, MakeBall({ -0.6, 0.0, 0.0 }, 0.2));
  RegionTarget target = MakeStandingBalls({ { { -0.6, 0.0, 0.0 }, 0.2 }, large });
  EXPECT_EQ(band.Advance(1e-3, MakeCreating(), target).CreatedParts, 1u);
  CheckSound(band, { 2, 0, 4 });
  const openvdb::FloatTree& tree = GetPotential(band)->tree();
  EXPECT_EQ(
    tree.probeConstLeaf(openvdb::Coord(static_cast<int>(large.Centre[0] / (H / 2.0)), 0, 0)),
    nullptr)
    << "a tile";
  for (int step = -14; step <= 14; ++step)
  {
    const int x = static_cast<int>(large.Centre[0] / (H / 2.0)) + step;
    EXPECT_LT(tree.getValue(openvdb::Coord(x, 0, 0)), 0.f) << step << " voxels from the centre";
  }
}

// AllNodes samples all nodes of a box, because parts may be away from its centre.
TEST(TestNewParts, OneBoxFindsAllParts)
{
  const std::vector<Ball> balls = { Left, Right, { { 0.0, 0.7, 0.7 }, 0.1 },
    { { 0.7, -0.7, 0.1 }, 1.5 * H } };
  RegionTarget target = MakeStanding(
    MakeBalls(balls), { RegionAround({ { 0.0, 0.0, 0.0 }, 0.95 }, RegionSeeds::AllNodes) });
  const auto band = StartWith(MakeBalls({ Left }));
  EXPECT_EQ(band->Advance(1e-3, MakeCreating(), target).CreatedParts, 3u);
  CheckSound(*band, { 4, 0, 8 });
}

// A region that meets a part is enough: the search follows the part beyond the region.
TEST(TestNewParts, PartOutgrowsItsRegion)
{
  RegionTarget target = MakeStanding(
    MakeBalls({ Left, Right }), { RegionAround({ Right.Centre, H }, RegionSeeds::PartAtCentre) });
  const auto band = StartWith(MakeBalls({ Left }));
  EXPECT_EQ(band->Advance(1e-3, MakeCreating(), target).CreatedParts, 1u);
  const Range radii = GetRadii(VerticesBeyond(Polygonise(*band), 0.0), Right.Centre);
  EXPECT_NEAR((radii.Minimum - Right.Radius) / H, 0.0, 0.04);
  EXPECT_NEAR((radii.Maximum - Right.Radius) / H, 0.0, 0.04);
}
}
