// A start near the points of a surface is bitwise identical to a start from all nodes of the box.

#include "Support/RandomShapes.h"
#include "Support/SurfaceMeasures.h"
#include "Support/Throws.h"

#include "Base/LatticeShape.h"
#include "Leaves/LeafTable.h"
#include "Surface/LatticeSurface.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <vector>

using namespace activesurface;

namespace TestNearbyStart
{
constexpr int Nodes = 48;
constexpr double H = VoxelSizeOf(Nodes);

/** Function with the points of its surface, found on a lattice of this spacing. Lattice nodes
 * differ from the band's nodes. */
InitialFunction MakeKnown(const Shape& shape, double spacing, const std::vector<Ball>& around)
{
  InitialFunction function = MakeInitialFunction(shape);
  LatticeShape lattice;
  lattice.Origin = openvdb::Vec3d(0.3, 0.1, 0.7) * spacing;
  for (openvdb::Vec3d& axis : lattice.Axis)
  {
    axis *= spacing;
  }
  for (const Ball& ball : around)
  {
    openvdb::CoordBBox box;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double centre = (ball.Centre[axis] - lattice.Origin[axis]) / spacing;
      const double radius = ball.Radius / spacing;
      box.min()[axis] = static_cast<int>(std::floor(centre - radius));
      box.max()[axis] = static_cast<int>(std::ceil(centre + radius));
    }
    for (auto it = box.begin(); it; ++it)
    {
      const openvdb::Vec3d place = lattice.PlaceOf((*it).asVec3d());
      if (shape.Value({ place[0], place[1], place[2] }) < 0.0)
      {
        lattice.Inside.setValueOn(*it);
      }
    }
  }
  function.Surface = FindSurfacePoints(lattice);
  return function;
}

std::unique_ptr<NarrowBand> StartIn(
  const double bounds[6], const InitialFunction& function, int threads = 0)
{
  auto band = std::make_unique<NarrowBand>(H);
  band->SetNumberOfThreads(threads);
  band->Start(0.0, bounds, function);
  return band;
}

// Balls are wider than two cells, so the lattice detects each of them.
TEST(TestNearbyStart, HasTheBytesOfADenseStart)
{
  RandomShapes random(31);
  std::vector<Ball> balls;
  for (int i = 0; i < 12; ++i)
  {
    const double x = random.DrawBetween(-0.7, 0.7), y = random.DrawBetween(-0.7, 0.7);
    const double z = random.DrawBetween(-0.7, 0.7);
    balls.push_back({ { x, y, z }, random.DrawBetween(0.15, 0.3) });
  }
  const Shape shape = MakeBalls(balls);
  const auto dense = StartIn(Box, MakeInitialFunction(shape));
  for (const double spacing : { 0.5 * H, 0.9 * H, 1.7 * H })
  {
    EXPECT_TRUE(AreIdentical(*dense, *StartIn(Box, MakeKnown(shape, spacing, balls)))) << spacing;
  }
}

TEST(TestNearbyStart, ThreadsLeaveNoTrace)
{
  const tbb::global_control fourThreads(tbb::global_control::max_allowed_parallelism, 4);
  const std::vector<Ball> balls = { { CentreA, 0.6 } };
  const InitialFunction function = MakeKnown(MakeBalls(balls), H, balls);
  EXPECT_TRUE(AreIdentical(*StartIn(Box, function, 1), *StartIn(Box, function, 4)));
}

// A solid is closed at the faces of the bounds, although its own surface is elsewhere.
TEST(TestNearbyStart, SolidIsClosedAtTheBounds)
{
  const double cuts[2][6] = { { -0.4, 0.5, -0.3, 0.3, -1.0, 1.0 },
    { -0.2, 0.2, -0.2, 0.2, -0.2, 0.2 } };
  const std::vector<Ball> balls = { { { 0.1, 0.05, 0.0 }, 0.6 } };
  const Shape shape = MakeBalls(balls);
  for (const double* bounds : cuts)
  {
    const auto dense = StartIn(bounds, MakeInitialFunction(shape));
    EXPECT_TRUE(AreIdentical(*dense, *StartIn(bounds, MakeKnown(shape, H, balls)))) << bounds[0];
  }
}

// Walls two voxels within the bounds cut the function itself.
TEST(TestNearbyStart, WallsWithinTheBoundsCutTheShape)
{
  const std::vector<Ball> balls = { { { 0.1, 0.05, 0.0 }, 0.6 } };
  const Shape ball = MakeBalls(balls);
  const double wall = 0.4, half = wall + 2.0 * H;
  const Shape cut = { [&](const Point& x)
    {
      double most = ball.Value(x);
      for (const double c : x)
      {
        most = std::max(most, std::fabs(c) - wall);
      }
      return most;
    },
    {} };
  const double bounds[6] = { -half, half, -half, half, -half, half };
  InitialFunction function = MakeKnown(ball, H, balls);
  function.Evaluate = MakeInitialFunction(cut).Evaluate;
  function.Surface.DepthOfWalls = 2.0 * H;
  EXPECT_TRUE(AreIdentical(*StartIn(bounds, MakeInitialFunction(cut)), *StartIn(bounds, function)));
}

std::size_t CountEvaluations(InitialFunction function, const double bounds[6], std::size_t& leaves)
{
  std::atomic<std::size_t> evaluations{ 0 };
  const auto evaluate = function.Evaluate;
  function.Evaluate = [evaluate, &evaluations](
                        std::size_t count, const double* points, double* values)
  {
    evaluations += count;
    evaluate(count, points, values);
  };
  leaves = StartIn(bounds, function)->GetLeaves().Size();
  return evaluations;
}

// Neither the size of the box nor the distance of the small ball affects the cost. The small ball,
// of 3 voxels, adds up to (3 + 4)^2 / (19 + 4)^2 = 9 % to the large ball, of 19 voxels, with layers
// of 4 voxels around both.
TEST(TestNearbyStart, CostIsThatOfTheSurface)
{
  std::vector<Ball> balls = { { CentreA, 0.8 } };
  const double wide[6] = { -4.0, 4.0, -4.0, 4.0, -4.0, 4.0 };
  std::size_t leaves = 0, leavesOfDense = 0, leavesOfWide = 0, leavesWithStray = 0;
  const std::size_t alone = CountEvaluations(MakeKnown(MakeBalls(balls), H, balls), Box, leaves);
  const std::size_t dense =
    CountEvaluations(MakeInitialFunction(MakeBalls(balls)), Box, leavesOfDense);
  EXPECT_LT(alone, dense);
  EXPECT_EQ(CountEvaluations(MakeKnown(MakeBalls(balls), H, balls), wide, leavesOfWide), alone);
  EXPECT_EQ(leavesOfWide, leaves);
  const double far = 1e6 * H;
  balls.push_back({ { far, far, far }, 3.0 * H });
  const double widest[6] = { -1.0, far + 1.0, -1.0, far + 1.0, -1.0, far + 1.0 };
  const std::size_t with =
    CountEvaluations(MakeKnown(MakeBalls(balls), H, balls), widest, leavesWithStray);
  EXPECT_GT(with, alone);
  EXPECT_LT(with, alone + alone / 10);
  EXPECT_LE(leavesWithStray - leaves, 27u);
}

TEST(TestNearbyStart, WhatIsNotANumberIsOutside)
{
  const std::vector<Ball> balls = { { CentreA, 0.6 } };
  Shape shape = MakeBalls(balls);
  const auto value = shape.Value;
  shape.Value = [value](const Point& x)
  { return x[0] > 0.3 ? std::numeric_limits<double>::quiet_NaN() : value(x); };
  EXPECT_TRUE(AreIdentical(
    *StartIn(Box, MakeInitialFunction(shape)), *StartIn(Box, MakeKnown(shape, H, balls))));
}

TEST(TestNearbyStart, NothingAndTooMuch)
{
  InitialFunction none = MakeInitialFunction(MakeConstant(1.0));
  none.Surface.ForEach = [](const std::function<void(const double x[3])>&) {};
  EXPECT_TRUE(StartIn(Box, none)->IsEmpty());
  const std::vector<Ball> balls = { { CentreA, 0.6 } };
  const InitialFunction function = MakeKnown(MakeBalls(balls), H, balls);
  NarrowBand band(H);
  band.SetMaximumNumberOfActiveVoxels(2000);
  EXPECT_TRUE(Throws<std::runtime_error>(
    [&] { band.Start(0.0, Box, function); }, "MaximumNumberOfActiveVoxels"));
  EXPECT_TRUE(band.IsEmpty());
  band.SetMaximumNumberOfActiveVoxels(100000);
  EXPECT_FALSE(band.Start(0.0, Box, function, [](double) { return false; }));
  EXPECT_TRUE(band.IsEmpty());
}

// The lattice would have two billion nodes along each axis.
TEST(TestNearbyStart, VoxelsThatAreFarTooSmallAreRefusedAtOnce)
{
  const std::vector<Ball> balls = { { CentreA, 0.6 } };
  InitialFunction function = MakeKnown(MakeBalls(balls), H, balls);
  int evaluations = 0;
  function.Evaluate = [&](std::size_t, const double*, double*) { ++evaluations; };
  function.ThreadSafe = false;
  NarrowBand band(1e-9);
  band.SetMaximumNumberOfActiveVoxels(1000000);
  EXPECT_TRUE(Throws<std::runtime_error>(
    [&] { band.Start(0.0, Box, function); }, "MaximumNumberOfActiveVoxels"));
  EXPECT_EQ(evaluations, 0);
}

}
