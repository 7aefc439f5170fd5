// Scenes of absurd size, far from the origin, or with absurd values give the right result or an
// immediate error.

#include "Support/AnalyticShapes.h"
#include "Support/SurfaceMeasures.h"
#include "Support/Throws.h"

#include "Surface/Skin.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

using namespace activesurface;

namespace TestExtremes
{

// Some functions are defined only within a box and return a huge number elsewhere.
TEST(TestExtremes, HugeValuesFarFromTheSurfaceDoNotSpoilTheStart)
{
  const double h = VoxelSizeOf(40);
  for (const double huge : { 1e5, 1e30, 1e300, HUGE_VAL })
  {
    Shape ball = MakeBall(CentreA, 0.6);
    const auto distance = ball.Value;
    ball.Value = [distance, huge](const Point& x)
    { return std::fabs(x[0]) > 0.75 ? huge : distance(x); };
    NarrowBand band(h);
    StartOn(band, ball);
    const Range radii = GetRadii(Polygonise(band), CentreA);
    // Linear crossings of a distance are off by at most h^2 / (8 r) = h / 93.
    EXPECT_NEAR((radii.Mean - 0.6) / h, 0.0, 0.011) << "error of the radius [h], " << huge;
    EXPECT_LT(radii.GetSpread() / h, 0.022) << "spread of the radii [h], " << huge;
  }
}

TEST(TestExtremes, BoundsThatWouldTakeMinutesToSampleAreRefused)
{
  NarrowBand band(0.05);
  band.SetMaximumNumberOfActiveVoxels(50000000);
  const double wide[6] = { -50.0, 50.0, -50.0, 50.0, -50.0, 50.0 };
  EXPECT_TRUE(Throws<std::runtime_error>(
    [&] { band.Start(0.0, wide, MakeInitialFunction(MakeBall(CentreA, 0.6))); }, "too many"))
    << "2000^3 nodes are more than 40 * 50000000";
}

// At 2^20 voxels from the origin, single precision rounds by up to a sixteenth of a voxel.
TEST(TestExtremes, SkinFarFromTheOriginKeepsItsPrecision)
{
  const double h = 0.0625, far = h * (1 << 20);
  const Point centre = { far + CentreA[0], CentreA[1], CentreA[2] };
  const double bounds[6] = { far - 1.0, far + 1.0, -1.0, 1.0, -1.0, 1.0 };
  NarrowBand band(h);
  band.Start(0.0, bounds, MakeInitialFunction(MakeBall(centre, 0.6)));
  const Skin skin(band);
  EXPECT_TRUE(skin.NeedsDoublePrecision()) << "precision of the skin";
  std::vector<double> points(3 * skin.GetNumberOfPoints());
  std::vector<std::int64_t> corners(3 * skin.GetNumberOfTriangles());
  skin.Write(points.data(), nullptr, corners.data());
  double largest = 0.0;
  for (std::size_t i = 0; i < points.size(); i += 3)
  {
    const double radius =
      std::hypot(points[i] - centre[0], points[i + 1] - centre[1], points[i + 2] - centre[2]);
    largest = std::max(largest, std::fabs(radius - 0.6));
  }
  EXPECT_GT(points.size(), 0u) << "numbers";
  EXPECT_LT(largest / h, 0.02) << "largest error of the radii [h]";

  NarrowBand near(h);
  StartOn(near, MakeBall(CentreA, 0.6));
  EXPECT_FALSE(Skin(near).NeedsDoublePrecision()) << "single precision near the origin";
}

int CountThreads(const NarrowBand& band)
{
  int threads = 0;
  band.Run([&threads] { threads = tbb::this_task_arena::max_concurrency(); });
  return threads;
}

TEST(TestExtremes, AbsurdNumberOfThreadsIsCapped)
{
  NarrowBand few(VoxelSizeOf(32)), many(VoxelSizeOf(32));
  few.SetNumberOfThreads(2);
  many.SetNumberOfThreads(2000000000);
  EXPECT_EQ(CountThreads(few), 2) << "threads, as many as asked for";
  EXPECT_EQ(CountThreads(many), 1024) << "threads, as NarrowBand.h says";
  for (NarrowBand* band : { &few, &many })
  {
    StartOn(*band, MakeBall(CentreA, 0.5));
    ShapeTarget target(MakeBall(CentreA, 0.6));
    EXPECT_GT(band->Advance(0.5, Motion(), target).Substeps, 0u) << "substeps";
  }
  EXPECT_TRUE(AreIdentical(few, many)) << "the same to the bit";
}

}
