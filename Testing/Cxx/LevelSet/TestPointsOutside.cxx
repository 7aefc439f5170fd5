// Points outside the skin, compared with the points found from distances to all triangles.

#include "Support/AnalyticShapes.h"
#include "Support/SurfaceMeasures.h"

#include "NarrowBand.h"
#include "Surface/PointsOutside.h"
#include "Surface/Skin.h"
#include "Surface/SkinDistance.h"

#include <gtest/gtest.h>
#include <openvdb/math/Proximity.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

using namespace activesurface;

namespace TestPointsOutside
{

namespace
{

using openvdb::Vec3d;

constexpr int Nodes = 32;

struct Triangles
{
  std::vector<double> Points;
  std::vector<std::int64_t> Corners;

  explicit Triangles(const NarrowBand& band)
  {
    const Skin skin(band);
    this->Points.resize(3 * skin.GetNumberOfPoints());
    this->Corners.resize(3 * skin.GetNumberOfTriangles());
    skin.Write(this->Points.data(), nullptr, this->Corners.data());
  }

  double GetDistance(const Vec3d& place) const
  {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t < this->Corners.size(); t += 3)
    {
      const Vec3d a(this->Points.data() + 3 * this->Corners[t]);
      const Vec3d b(this->Points.data() + 3 * this->Corners[t + 1]);
      const Vec3d c(this->Points.data() + 3 * this->Corners[t + 2]);
      Vec3d weights;
      const Vec3d foot = openvdb::math::closestPointOnTriangleToPoint(a, b, c, place, weights);
      least = std::min(least, (foot - place).length());
    }
    return least;
  }
};

/** Random points in the box, with margins of up to `mostVoxels` voxels. */
std::vector<PointWithMargin> MakePoints(double mostVoxels)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-1.0, 1.0), part(0.0, 1.0);
  std::vector<PointWithMargin> points(1000);
  for (PointWithMargin& point : points)
  {
    for (double& x : point.Position)
    {
      x = place(random);
    }
    point.Margin = mostVoxels * VoxelSizeOf(Nodes) * part(random);
  }
  return points;
}

}

// Margins are within a voxel, within the band, and far beyond the band. A shell has an outside in
// its cavity.
TEST(TestPointsOutside, TheyAreThoseFarFromAllTriangles)
{
  NarrowBand band(VoxelSizeOf(Nodes));
  for (const Shape& shape : { MakeShell(0.7, 0.4), MakeSixMetaballs() })
  {
    StartOn(band, shape);
    const Triangles triangles(band);
    const SkinDistance signs(band);
    for (const double voxels : { 1.0, 4.0, 12.0 })
    {
      const std::vector<PointWithMargin> points = MakePoints(voxels);
      for (const PointWithMargin& point : points)
      {
        const bool isOutside = signs.Evaluate(point.Position, nullptr) > 0.0 &&
          triangles.GetDistance(Vec3d(point.Position)) > point.Margin;
        EXPECT_EQ(CountOutside(band, { point }), isOutside ? 1u : 0u)
          << "at " << Vec3d(point.Position) << ", margin " << point.Margin;
      }
    }
  }
}

TEST(TestPointsOutside, ThreadsDoNotMatter)
{
  NarrowBand band(VoxelSizeOf(Nodes));
  StartOn(band, MakeBall(CentreA, 0.5));
  const std::vector<PointWithMargin> points = MakePoints(3.0);
  band.SetNumberOfThreads(1);
  const std::size_t one = CountOutside(band, points);
  band.SetNumberOfThreads(2);
  EXPECT_EQ(CountOutside(band, points), one);
  EXPECT_GT(one, 0u);
  EXPECT_LT(one, points.size());
}

TEST(TestPointsOutside, FarIsOutsideAndNowhereIsNot)
{
  NarrowBand band(VoxelSizeOf(Nodes));
  StartOn(band, MakeBall(CentreA, 0.5));
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(CountOutside(band, { { { 1e300, 0.0, 0.0 }, 0.1 } }), 1u) << "beyond all coordinates";
  EXPECT_EQ(CountOutside(band, { { { 1e6, 0.0, 0.0 }, 2e6 } }), 0u) << "within a wide margin";
  EXPECT_EQ(CountOutside(band, { { { std::nan(""), 0.0, 0.0 }, 0.1 } }), 0u) << "not a number";
  EXPECT_EQ(CountOutside(band, { { { 0.9, 0.9, 0.9 }, infinity } }), 0u) << "no margin";
  EXPECT_EQ(CountOutside(band, {}), 0u) << "no points";
}

TEST(TestPointsOutside, WithoutASurfaceAllAreOutside)
{
  const NarrowBand empty(VoxelSizeOf(Nodes));
  EXPECT_EQ(CountOutside(empty, MakePoints(3.0)), 1000u);
}

}
