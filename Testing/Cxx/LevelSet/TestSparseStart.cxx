// A start from regions gives the same surface as a start from all nodes of the box. Its cost
// depends only on the regions.

#include "Support/RandomShapes.h"
#include "Support/SurfaceMeasures.h"
#include "Support/Throws.h"

#include "Leaves/LeafTable.h"
#include "NarrowBandGrid.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <vector>

using namespace activesurface;

namespace TestSparseStart
{
constexpr int Nodes = 48;

TargetRegion RegionAround(const Ball& ball)
{
  TargetRegion region;
  for (int axis = 0; axis < 3; ++axis)
  {
    region.Bounds[2 * axis] = ball.Centre[axis] - ball.Radius;
    region.Bounds[2 * axis + 1] = ball.Centre[axis] + ball.Radius;
  }
  return region;
}

InitialFunction MakeSparse(const Shape& shape, const std::vector<TargetRegion>& regions)
{
  InitialFunction function = MakeInitialFunction(shape);
  function.ForEachRegion = [regions](const RegionVisitor& visit)
  { std::for_each(regions.begin(), regions.end(), visit); };
  return function;
}

InitialFunction MakeSparseBalls(const std::vector<Ball>& balls)
{
  std::vector<TargetRegion> regions;
  std::transform(balls.begin(), balls.end(), std::back_inserter(regions), RegionAround);
  return MakeSparse(MakeBalls(balls), regions);
}

std::unique_ptr<NarrowBand> StartIn(
  const double bounds[6], const InitialFunction& function, int threads = 0)
{
  auto band = std::make_unique<NarrowBand>(VoxelSizeOf(Nodes));
  band->SetNumberOfThreads(threads);
  band->Start(0.0, bounds, function);
  return band;
}

struct Difference
{
  std::size_t Nodes = 0;       //< active in both
  std::size_t Signs = 0;       //< that differ, at any node of a leaf of either
  double Largest = 0.0;        //< of u at nodes active in both
  double LargestAtEdges = 0.0; //< of u at nodes of crossed edges
};

bool HasCrossedEdge(const openvdb::FloatTree& tree, const openvdb::Coord& node)
{
  const bool isInside = tree.getValue(node) < 0.f;
  for (int face = 0; face < 6; ++face)
  {
    openvdb::Coord next = node;
    next[face / 2] += face % 2 ? 1 : -1;
    if ((tree.getValue(next) < 0.f) != isInside)
    {
      return true;
    }
  }
  return false;
}

Difference Compare(const NarrowBand& first, const NarrowBand& second)
{
  Difference difference;
  for (const auto& [from, to] : { std::pair(&first, &second), std::pair(&second, &first) })
  {
    const openvdb::FloatTree& tree = GetPotential(*to)->tree();
    for (auto leaf = GetPotential(*from)->tree().cbeginLeaf(); leaf; ++leaf)
    {
      for (auto it = leaf->cbeginValueAll(); it; ++it)
      {
        const float value = tree.getValue(it.getCoord());
        difference.Signs += (value < 0.f) != (*it < 0.f);
        if (it.isValueOn() && tree.isValueOn(it.getCoord()))
        {
          ++difference.Nodes;
          const double of = std::fabs(double(value) - *it);
          difference.Largest = std::max(difference.Largest, of);
          if (HasCrossedEdge(tree, it.getCoord()))
          {
            difference.LargestAtEdges = std::max(difference.LargestAtEdges, of);
          }
        }
      }
    }
  }
  return difference;
}

std::vector<Ball> DrawBalls(int count, double least, double most)
{
  RandomShapes random(471);
  std::vector<Ball> balls;
  for (int i = 0; i < count; ++i)
  {
    const double x = random.DrawBetween(-0.8, 0.8), y = random.DrawBetween(-0.8, 0.8);
    const double z = random.DrawBetween(-0.8, 0.8);
    balls.push_back({ { x, y, z }, random.DrawBetween(least, most) });
  }
  return balls;
}

// Both starts use |F| / |grad F| where F is a smooth distance. The dense start rounds F to single
// precision, which changes u by up to 3.7e-6 voxel.
constexpr double Rounding = 4e-6;

TEST(TestSparseStart, BallIsThatOfTheDenseStart)
{
  const Ball ball = { CentreA, 0.6 };
  const Difference difference = Compare(*StartIn(Box, MakeInitialFunction(MakeBalls({ ball }))),
    *StartIn(Box, MakeSparseBalls({ ball })));
  EXPECT_GT(difference.Nodes, 1000u);
  EXPECT_EQ(difference.Signs, 0u);
  EXPECT_LE(difference.Largest, Rounding);
}

// Regions lie only along the surface, not throughout the inside.
TEST(TestSparseStart, TorusIsThatOfTheDenseStart)
{
  constexpr double ring = 0.58, tube = 0.28; // a hole of 7 voxels, beyond the layers
  const Shape torus = MakeTorus(CentreA, ring, tube);
  std::vector<TargetRegion> regions;
  const int pieces = 60;
  constexpr double pi = 3.14159265358979323846;
  for (int i = 0; i < pieces * pieces; ++i)
  {
    const double a = 2.0 * pi * (i / pieces) / pieces, b = 2.0 * pi * (i % pieces) / pieces;
    const double r = ring + tube * std::cos(b);
    // Points of the surface are at most 2 pi 0.86 / 60 apart, so boxes meet whose half side is half
    // of that.
    regions.push_back(RegionAround({ { CentreA[0] + r * std::cos(a), CentreA[1] + r * std::sin(a),
                                       CentreA[2] + tube * std::sin(b) },
      pi * (ring + tube) / pieces }));
  }
  const Difference difference =
    Compare(*StartIn(Box, MakeInitialFunction(torus)), *StartIn(Box, MakeSparse(torus, regions)));
  EXPECT_GT(difference.Nodes, 1000u);
  EXPECT_EQ(difference.Signs, 0u);
  EXPECT_LE(difference.Largest, Rounding);
}

// F has creases where balls meet. There each start keeps u within half of a marched distance d',
// with d / sqrt(3) <= d' <= d for the distance d along edges, at most 6 voxels. So u is between 0.5
// / sqrt(3) and 1.5 times d.
constexpr double LargestDifferenceAtCreases = (1.5 - 0.5 / 1.7320508) * 6.0;

TEST(TestSparseStart, RandomBallsAreThoseOfTheDenseStart)
{
  const std::vector<Ball> balls = DrawBalls(100, 0.08, 0.2);
  const auto dense = StartIn(Box, MakeInitialFunction(MakeBalls(balls)));
  const auto sparse = StartIn(Box, MakeSparseBalls(balls));
  const Difference difference = Compare(*dense, *sparse);
  EXPECT_GT(difference.Nodes, 1000u);
  EXPECT_EQ(difference.Signs, 0u);
  EXPECT_LE(difference.Largest, LargestDifferenceAtCreases);
  const Mesh mesh = Polygonise(*sparse);
  EXPECT_EQ(FindDefects(mesh).Edges, 0u);
  // At the nodes of crossed edges the limits of both starts follow from the same planes.
  EXPECT_LE(difference.LargestAtEdges, Rounding);
}

// The surface lies between leaves: no leaf has nodes on both sides.
TEST(TestSparseStart, CubeOfWholeLeavesIsClosed)
{
  const double h = VoxelSizeOf(Nodes), centre = 7.5 * h, half = 8.0 * h;
  const Shape cube = { [centre, half](const Point& point)
    {
      double most = -half;
      for (const double x : point)
      {
        most = std::max(most, std::fabs(x - centre) - half);
      }
      return most;
    },
    {} };
  const auto sparse =
    StartIn(Box, MakeSparse(cube, { RegionAround({ { centre, centre, centre }, half }) }));
  const Difference difference = Compare(*StartIn(Box, MakeInitialFunction(cube)), *sparse);
  EXPECT_GT(difference.Nodes, 1000u);
  EXPECT_EQ(difference.Signs, 0u);
  EXPECT_LE(difference.LargestAtEdges, Rounding);
  EXPECT_EQ(FindDefects(Polygonise(*sparse)).Edges, 0u);
}

TEST(TestSparseStart, SolidIsClosedAtTheBounds)
{
  const Ball ball = { { 0.3, 0.2, 0.1 }, 1.2 };
  const Shape shape = MakeBalls({ ball });
  const Difference difference =
    Compare(*StartIn(Box, MakeInitialFunction(shape)), *StartIn(Box, MakeSparseBalls({ ball })));
  EXPECT_GT(difference.Nodes, 1000u);
  EXPECT_EQ(difference.Signs, 0u);
}

TEST(TestSparseStart, ThreadsAndOrderOfRegionsLeaveNoTrace)
{
  // Four threads are used on machines with two cores too.
  const tbb::global_control fourThreads(tbb::global_control::max_allowed_parallelism, 4);
  std::vector<Ball> balls = DrawBalls(100, 0.08, 0.2);
  const auto one = StartIn(Box, MakeSparseBalls(balls), 1);
  const auto four = StartIn(Box, MakeSparseBalls(balls), 4);
  EXPECT_TRUE(AreIdentical(*one, *four)) << "threads";
  InitialFunction function = MakeSparseBalls(balls);
  std::reverse(balls.begin(), balls.end());
  function.ForEachRegion = MakeSparseBalls(balls).ForEachRegion;
  EXPECT_TRUE(AreIdentical(*one, *StartIn(Box, function))) << "order";
}

// A ball of three voxels adds only the leaves that its box touches, at most 2 along an axis, and
// the layers.
TEST(TestSparseStart, StrayBallCostsItselfAlone)
{
  const double h = VoxelSizeOf(Nodes);
  std::vector<Ball> balls = { { CentreA, 0.6 } };
  std::atomic<std::size_t> evaluations{ 0 };
  const auto start = [&](const double bounds[6])
  {
    InitialFunction function = MakeSparseBalls(balls);
    const auto evaluate = function.Evaluate;
    function.Evaluate = [evaluate, &evaluations](
                          std::size_t count, const double* points, double* values)
    {
      evaluations += count;
      evaluate(count, points, values);
    };
    evaluations = 0;
    return StartIn(bounds, function);
  };
  const auto alone = start(Box);
  const std::size_t before = evaluations;
  const double far = 1e6 * h;
  balls.push_back({ { far, far, far }, 3.0 * h });
  const double wide[6] = { -1.0, far + 1.0, -1.0, far + 1.0, -1.0, far + 1.0 };
  const auto with = start(wide);
  EXPECT_EQ(GetTopology(Polygonise(*with)).Components, 2);
  EXPECT_LE(with->GetLeaves().Size() - alone->GetLeaves().Size(), 27u);
  EXPECT_LE(evaluations - before, 8u * 512u + 27u * 512u);
  EXPECT_GT(evaluations, before);
}

/** Boxes along the surface of a ball. */
std::vector<TargetRegion> RegionsAlong(const Ball& ball)
{
  constexpr double pi = 3.14159265358979323846;
  constexpr int pieces = 80;
  std::vector<TargetRegion> regions;
  for (int i = 0; i < pieces * pieces; ++i)
  {
    const double a = 2.0 * pi * (i / pieces) / pieces, b = pi * (i % pieces + 0.5) / pieces;
    // Points are at most 2 pi r / 80 apart, so boxes meet whose half side is half of that.
    regions.push_back(RegionAround({ { ball.Centre[0] + ball.Radius * std::cos(a) * std::sin(b),
                                       ball.Centre[1] + ball.Radius * std::sin(a) * std::sin(b),
                                       ball.Centre[2] + ball.Radius * std::cos(b) },
      pi * ball.Radius / pieces }));
  }
  return regions;
}

// Points within no region are not evaluated. They are inside if the adjacent leaves are, up to the
// bounds.
TEST(TestSparseStart, InsideIsFilledFromRegionsAlongTheSurface)
{
  const Ball within = { CentreA, 0.9 }, cut = { { 0.3, 0.2, 0.1 }, 1.2 };
  for (const Ball& ball : { within, cut })
  {
    const Shape shape = MakeBalls({ ball });
    const auto sparse = StartIn(Box, MakeSparse(shape, RegionsAlong(ball)));
    const Difference difference = Compare(*StartIn(Box, MakeInitialFunction(shape)), *sparse);
    EXPECT_GT(difference.Nodes, 1000u);
    EXPECT_EQ(difference.Signs, 0u) << "radius " << ball.Radius;
    EXPECT_EQ(FindDefects(Polygonise(*sparse)).Edges, 0u) << "radius " << ball.Radius;
    EXPECT_EQ(GetTopology(Polygonise(*sparse)).Voids, 0) << "radius " << ball.Radius;
  }
}

TEST(TestSparseStart, RegionsWithoutSurfaceStartEmpty)
{
  const Shape shape = MakeConstant(1.0);
  EXPECT_TRUE(StartIn(Box, MakeSparse(shape, {}))->IsEmpty()) << "no region";
  EXPECT_TRUE(StartIn(Box, MakeSparse(shape, { RegionAround({ CentreA, 0.3 }) }))->IsEmpty())
    << "positive everywhere";
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  TargetRegion wrong;
  wrong.Bounds[0] = nan;
  EXPECT_TRUE(StartIn(Box, MakeSparse(MakeBalls({ { CentreA, 0.5 } }), { wrong }))->IsEmpty())
    << "a region that is not finite";
  EXPECT_TRUE(
    StartIn(Box, MakeSparse(MakeConstant(nan), { RegionAround({ CentreA, 0.3 }) }))->IsEmpty())
    << "not a number";
}

TEST(TestSparseStart, MoreThanTheMaximumIsRefused)
{
  NarrowBand band(VoxelSizeOf(Nodes));
  band.SetMaximumNumberOfActiveVoxels(5000);
  const InitialFunction function = MakeSparseBalls({ { CentreA, 0.6 } });
  EXPECT_TRUE(Throws<std::runtime_error>(
    [&] { band.Start(0.0, Box, function); }, "MaximumNumberOfActiveVoxels"));
  EXPECT_TRUE(band.IsEmpty());
}

TEST(TestSparseStart, ProgressStopsIt)
{
  NarrowBand band(VoxelSizeOf(Nodes));
  EXPECT_FALSE(
    band.Start(0.0, Box, MakeSparseBalls({ { CentreA, 0.6 } }), [](double) { return false; }));
  EXPECT_TRUE(band.IsEmpty());
}
}
