// The level set of a skin is the exact distance to the skin's triangles.

#include "Support/AnalyticShapes.h"

#include "Grids/SkinBand.h"
#include "Grids/SkinGrids.h"
#include "NarrowBandGrid.h"

#include <gtest/gtest.h>
#include <openvdb/math/Proximity.h>
#include <openvdb/tools/Diagnostics.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

using namespace activesurface;

namespace TestVDBSurface
{

namespace
{

// A torus next to a ball, so near that their bands meet: the bands contain a medial axis.
double TorusAndBall(const double* x)
{
  const double ring = std::hypot(std::hypot(x[0], x[1]) - 0.5, x[2]) - 0.2;
  const double ball = std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]) - 0.2;
  return std::min(ring, ball);
}

std::unique_ptr<NarrowBand> MakeBand(double voxelSize)
{
  auto band = std::make_unique<NarrowBand>(voxelSize);
  const double bounds[6] = { -1.0, 1.0, -1.0, 1.0, -1.0, 1.0 };
  InitialFunction function;
  function.Evaluate = [](std::size_t count, const double* points, double* values)
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      values[i] = TorusAndBall(points + 3 * i);
    }
  };
  band->Start(0.0, bounds, function);
  return band;
}

double BruteDistance(const LatticeMesh& mesh, const openvdb::Vec3d& node)
{
  double square = std::numeric_limits<double>::infinity();
  for (const auto& t : mesh.Triangles)
  {
    openvdb::Vec3d weights;
    const openvdb::Vec3d foot = openvdb::math::closestPointOnTriangleToPoint(
      mesh.Points[t[0]], mesh.Points[t[1]], mesh.Points[t[2]], node, weights);
    square = std::min(square, (foot - node).lengthSqr());
  }
  return std::sqrt(square);
}

}

// Single precision rounds distances of up to 3 voxels by less than 2e-7. The search from a
// neighbour's nearest triangle may miss a nearer one behind an edge, but not here.
TEST(TestVDBSurface, DistancesAreThoseToTheTriangles)
{
  const auto band = MakeBand(0.05);
  const LatticeMesh mesh = MakeSkinMesh(*band);
  const MeshBand distances = MakeSkinBand(*band, mesh);
  double largest = 0.0;
  int count = 0;
  for (auto value = distances.Distances->cbeginValueOn(); value; ++value)
  {
    if (count++ % 7 == 0)
    {
      const double exact = BruteDistance(mesh, value.getCoord().asVec3d());
      largest = std::max(largest, std::fabs(std::fabs(*value) - exact));
    }
  }
  EXPECT_GT(count, 5000) << "nodes";
  EXPECT_LT(largest, 1e-6) << "largest miss in voxels";
}

// Checks the neighbours of active nodes along x.
TEST(TestVDBSurface, TheBandIsComplete)
{
  const auto band = MakeBand(0.1);
  const LatticeMesh mesh = MakeSkinMesh(*band);
  const MeshBand distances = MakeSkinBand(*band, mesh);
  const auto reader = distances.Distances->getConstAccessor();
  int missing = 0, beyond = 0;
  for (auto value = distances.Distances->cbeginValueOn(); value; ++value)
  {
    const openvdb::Coord beside = value.getCoord().offsetBy(1, 0, 0);
    const bool isMissing =
      !reader.isValueOn(beside) && BruteDistance(mesh, beside.asVec3d()) < HalfWidth - 1e-6;
    missing += isMissing ? 1 : 0;
    beyond += std::fabs(*value) >= HalfWidth ? 1 : 0;
  }
  EXPECT_EQ(missing, 0) << "nodes left out";
  EXPECT_EQ(beyond, 0) << "nodes beyond";
}

// The skin has its vertices at the linear crossings of edges. The crossings of the distances differ
// only by the curvature, by at most h / 4 r: 0.03 voxel for tube and ball, whose radii are 8
// voxels.
TEST(TestVDBSurface, TheZeroSetStaysWhereItIs)
{
  const auto band = MakeBand(0.025);
  const MeshBand distances = MakeSkinBand(*band, MakeSkinMesh(*band));
  const auto potential = GetPotential(*band);
  const auto before = potential->getConstAccessor();
  const auto after = distances.Distances->getConstAccessor();
  double largest = 0.0;
  int count = 0;
  for (auto value = potential->cbeginValueOn(); value; ++value)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      openvdb::Coord next = value.getCoord();
      next[axis] += 1;
      const double u[2] = { *value, before.getValue(next) };
      const double d[2] = { after.getValue(value.getCoord()), after.getValue(next) };
      if ((u[0] < 0.0) != (u[1] < 0.0))
      {
        largest = std::max(largest, std::fabs(u[0] / (u[0] - u[1]) - d[0] / (d[0] - d[1])));
        count += (d[0] < 0.0) == (u[0] < 0.0) ? 1 : 0;
      }
    }
  }
  EXPECT_GT(count, 1000) << "crossings of the same sign";
  EXPECT_LT(largest, 0.05) << "largest shift in voxels";
}

TEST(TestVDBSurface, OpenVDBFindsNoDefect)
{
  for (const double voxelSize : { 0.1, 0.05, 0.025 })
  {
    const auto band = MakeBand(voxelSize);
    const auto grid = MakeSurfaceGrid(MakeSkinBand(*band, MakeSkinMesh(*band)), voxelSize);
    EXPECT_EQ(openvdb::tools::checkLevelSet(*grid, 8), std::string()) << "checks 1 to 8";
    EXPECT_EQ(grid->background(), static_cast<float>(3.0 * voxelSize)) << "background";
    EXPECT_EQ(grid->voxelSize()[0], voxelSize) << "voxel size";
  }
  const auto band = MakeBand(0.025); // the ball's radius is 8 voxels
  const MeshBand distances = MakeSkinBand(*band, MakeSkinMesh(*band));
  EXPECT_EQ(distances.Distances->tree().getValue(openvdb::Coord(0)), -3.f) << "deep inside";
}

TEST(TestVDBSurface, ThreadsDoNotChangeDistances)
{
  const auto band = MakeBand(0.05);
  const LatticeMesh mesh = MakeSkinMesh(*band);
  band->SetNumberOfThreads(1);
  const MeshBand one = MakeSkinBand(*band, mesh);
  band->SetNumberOfThreads(4);
  const MeshBand four = MakeSkinBand(*band, mesh);
  int different = 0;
  for (auto value = one.Distances->cbeginValueOn(); value; ++value)
  {
    different += four.Distances->tree().getValue(value.getCoord()) != *value ? 1 : 0;
  }
  EXPECT_EQ(different, 0) << "values";
  EXPECT_EQ(four.Distances->activeVoxelCount(), one.Distances->activeVoxelCount()) << "voxels";
}

}
