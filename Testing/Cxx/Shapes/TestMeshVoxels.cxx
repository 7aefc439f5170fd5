// Estimated number of voxels near a mesh, compared with the actual one.

#include "Grid/MeshDistance.h"
#include "Grid/MeshVoxels.h"
#include "Input/MeshTriangles.h"
#include "Shapes/MeshShapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

using namespace activesurface;

namespace TestMeshVoxels
{

namespace
{

constexpr double Band = 5.0;

// The estimate counts cubes. At bends, several cubes contain the same part of the band, hence the
// tolerance of a factor of two.
void CheckEstimate(vtkPolyData* polygons, const std::string& what)
{
  const MeshTriangles mesh = ReadTriangles(polygons);
  const auto taken =
    static_cast<double>(MakeMeshDistance(mesh, { 1.0, Band, false })->activeVoxelCount());
  // The bounding boxes contain more voxels than the maximum, so that cubes are counted.
  const double told = EstimateVoxelsNear(mesh, 1.0, Band, 4.0 * taken);
  EXPECT_GT(told, 0.5 * taken) << what << " takes " << taken;
  EXPECT_LT(told, 2.0 * taken) << what << " takes " << taken;
}

// Long triangles of negligible width, from the origin to points all around.
vtkSmartPointer<vtkPolyData> MakeNeedles(int count, double length)
{
  std::vector<Point> points{ { 0.0, 0.0, 0.0 } };
  std::vector<std::vector<vtkIdType>> needles;
  for (int i = 0; i < count; ++i)
  {
    const double height = count == 1 ? 0.3 : -1.0 + (2.0 * i + 1.0) / count;
    const double around = 2.4 * i, wide = length * std::sqrt(1.0 - height * height);
    const Point end{ wide * std::cos(around), wide * std::sin(around), length * height };
    points.push_back(end);
    points.push_back({ end[0], end[1] + 0.1, end[2] + 0.1 });
    needles.push_back({ 0, 2 * i + 1, 2 * i + 2 });
  }
  return MakeMesh(points, needles);
}

}

TEST(TestMeshVoxels, SpheresOfSmallTriangles)
{
  CheckEstimate(MakeSphere(100.0, 100), "a sphere");
}

TEST(TestMeshVoxels, SpheresOfLargeTriangles)
{
  CheckEstimate(MakeSphere(150.0, 6), "a diamond");
}

// An estimate from areas would be nearly 0.
TEST(TestMeshVoxels, Needles)
{
  CheckEstimate(MakeNeedles(1, 2000.0), "a needle");
  CheckEstimate(MakeNeedles(40, 400.0), "forty needles");
}

TEST(TestMeshVoxels, SmallMeshesAreWithinTheirBox)
{
  const MeshTriangles mesh = ReadTriangles(MakeCube(-10.0, 10.0));
  EXPECT_EQ(EstimateVoxelsNear(mesh, 1.0, 5.0, 1e9), 30.0 * 30.0 * 11.0);
}

// Halving the longest edge again and again would make 3^n pieces of 2^-n of the needle's length.
TEST(TestMeshVoxels, NeedlesOfAMillionVoxelsTakeNoTime)
{
  const MeshTriangles mesh = ReadTriangles(
    MakeMesh({ { 0.0, 0.0, 0.0 }, { 1e6, 0.0, 1e3 }, { 1.0, 0.0, 0.0 } }, { { 0, 1, 2 } }));
  // 10^5 cubes along the needle, and one more for each of 100 sideways steps.
  EXPECT_NEAR(EstimateVoxelsNear(mesh, 1.0, Band, 1e9), 1e8, 1e6);
}

// The input has 2 * 10^9 voxels along each axis. Memory and time are limited by the maximum.
TEST(TestMeshVoxels, CountingEndsBeyondTheMaximum)
{
  const MeshTriangles mesh = ReadTriangles(MakeSphere(1e9, 20));
  for (const double band : { 5.0, 1e6, 1e200, std::numeric_limits<double>::infinity() })
  {
    EXPECT_GT(EstimateVoxelsNear(mesh, 1.0, band, 1e6), 1e6) << band;
  }
}

}
