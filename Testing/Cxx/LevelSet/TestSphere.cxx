// A ball after its start: area, volume, and the number of stored nodes.

#include "NarrowBandGrid.h"
#include "Support/RandomShapes.h"
#include "Support/SurfaceMeasures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

using namespace activesurface;

namespace TestSphere
{
constexpr double Pi = 3.14159265358979323846;
constexpr double Radius = 0.6;

std::string Name(int n)
{
  return "n = " + std::to_string(n);
}

// The skin is inscribed in the sphere. Its volume is too small by h^2 / 2 r^2, 0.58 % at n = 32,
// its area by half of that. Triangles along a voxel's diagonals are wider, which adds up to 30 %.
void CheckAreaAndVolume(int n, const Ball& ball, double areaTolerance, double volumeTolerance)
{
  NarrowBand band(VoxelSizeOf(n));
  StartOn(band, MakeBall(ball.Centre, ball.Radius));
  const Mesh mesh = Polygonise(band);
  const double square = ball.Radius * ball.Radius;
  const double area = GetArea(mesh) / (4.0 * Pi * square);
  const double volume = GetVolume(mesh) / (4.0 / 3.0 * Pi * square * ball.Radius);
  EXPECT_NEAR(area, 1.0, areaTolerance) << "area of the ball over the exact one, " << Name(n);
  EXPECT_NEAR(volume, 1.0, volumeTolerance) << "volume of the ball over the exact one, " << Name(n);
}

TEST(TestSphere, BallHasExactAreaAndVolume)
{
  const Ball ball = { CentreA, Radius };
  CheckAreaAndVolume(32, ball, 0.004, 0.0075);
  CheckAreaAndVolume(64, ball, 0.001, 0.0018);
  CheckAreaAndVolume(128, ball, 0.00025, 0.0005);
}

// The deficit is proportional to h^2 / r^2, so the tolerances apply to radii of 0.6 or more.
Ball DrawBall(RandomShapes& random)
{
  const Point centre = random.DrawPointNear(CentreA);
  return { centre, random.DrawBetween(Radius, 1.1 * Radius) };
}

TEST(TestSphere, BallHasExactAreaAndVolumeAtRandom)
{
  RandomShapes random(1);
  for (int i = 0; i < 4; ++i)
  {
    CheckAreaAndVolume(32, DrawBall(random), 0.004, 0.0075);
    CheckAreaAndVolume(64, DrawBall(random), 0.001, 0.0018);
  }
  CheckAreaAndVolume(128, DrawBall(random), 0.00025, 0.0005);
}

// Linear interpolation of a distance along an edge is wrong by at most h^2 / 8 r.
TEST(TestSphere, BallHasExactRadius)
{
  for (const int n : { 32, 64 })
  {
    const double h = VoxelSizeOf(n);
    NarrowBand band(h);
    StartOn(band, MakeBall(CentreB, Radius));
    const Range radii = GetRadii(Polygonise(band), CentreB);
    const double tolerance = h / Radius / 8.0 + 1e-5;
    EXPECT_NEAR((radii.Minimum - Radius) / h, 0.0, tolerance) << "least radius [h], " << Name(n);
    EXPECT_NEAR((radii.Maximum - Radius) / h, 0.0, tolerance) << "largest radius [h], " << Name(n);
  }
}

// The number of layers around a surface is constant, so the number of nodes grows as n^2.
void CheckNodes(int n, const Ball& ball)
{
  NarrowBand band(VoxelSizeOf(n));
  StartOn(band, MakeBall(ball.Centre, ball.Radius));
  const double square = std::pow(n * ball.Radius / Radius, 2);
  const double active = band.GetNumberOfActiveNodes() / square;
  const double ghosts = band.GetNumberOfGhosts() / square;
  EXPECT_NEAR(active, 7.0, 0.05 * 7.0) << "active nodes / n^2, " << Name(n);
  EXPECT_NEAR(ghosts, 3.8, 0.05 * 3.8) << "ghosts / n^2, " << Name(n);
}

TEST(TestSphere, NodesGrowWithTheSurfaceNotTheVolume)
{
  for (const int n : { 32, 64, 128 })
  {
    CheckNodes(n, { CentreA, Radius });
  }
}

// The constants 7 and 3.8 are those of large balls, at n = 32 from a radius of 0.6 on.
TEST(TestSphere, NodesGrowWithTheSurfaceNotTheVolumeAtRandom)
{
  RandomShapes random(13);
  for (const int n : { 32, 32, 64, 64, 128 })
  {
    CheckNodes(n, DrawBall(random));
  }
}

/** Largest error of the potential at the active nodes [voxels]. */
double GetLargestError(const NarrowBand& band, const Shape& distance)
{
  const double h = band.GetVoxelSize();
  double largest = 0.0;
  for (auto node = GetPotential(band)->cbeginValueOn(); node; ++node)
  {
    const openvdb::Coord& at = node.getCoord();
    const double exact = distance.Value({ h * at[0], h * at[1], h * at[2] }) / h;
    largest = std::max(largest, std::fabs(*node - exact));
  }
  return largest;
}

// The ball is large enough for several slabs in a sweep. Central differences of a distance have the
// norm 1 up to (h / r)^2, 2e-4.
TEST(TestSphere, DistancesHaveNoSeams)
{
  const double h = VoxelSizeOf(256);
  NarrowBand band(h);
  StartOn(band, MakeBall(CentreA, Radius));
  EXPECT_GT(band.GetNumberOfActiveNodes(), 400000u) << "active nodes";
  EXPECT_LT(GetLargestError(band, MakeBall(CentreA, Radius)), 0.001) << "error of a distance [h]";
}

// Two balls, each in a slab of its own, and a slab between them that contains both. The values of
// the right ball may be 1e20 times those of the left ball. The left values then vanish by rounding
// in the shared slab: an error of half a voxel at worst.
TEST(TestSphere, BodiesFarApartAreBothThere)
{
  const Shape left = MakeBall({ -0.513, 0.007, 0.011 }, 0.4);
  const Shape right = MakeBall({ 0.491, -0.013, 0.005 }, 0.4);
  for (const double factor : { 1.0, 1e20 })
  {
    const Shape both = {
      [&](const Point& at) { return at[0] < -0.01 ? left.Value(at) : factor * right.Value(at); }, {}
    };
    NarrowBand band(VoxelSizeOf(256));
    StartOn(band, both);
    const std::string name = factor == 1.0 ? "" : ", of unlike size";
    const Mesh mesh = Polygonise(band);
    EXPECT_EQ(GetTopology(mesh).Components, 2) << "bodies" << name;
    // Both balls are too small by h^2 / 2 r^2, 2e-4. An error of half a voxel at one ball is 1.5 %
    // of the volume of both.
    const double exact = 2.0 * 4.0 / 3.0 * Pi * 0.4 * 0.4 * 0.4;
    EXPECT_NEAR(GetVolume(mesh) / exact, 1.0, factor == 1.0 ? 4e-4 : 0.015) << "volume" << name;
    if (factor == 1.0)
    {
      EXPECT_LT(GetLargestError(band, both), 0.001) << "error of a distance [h]";
    }
  }
}

// A disk without thickness, inside only by rounding, in a slab of its own beside a ball.
TEST(TestSphere, SheetOfNoThicknessIsNoError)
{
  const double h = VoxelSizeOf(256);
  const double plane = -115.0 * h;
  const Shape ball = MakeBall({ 0.491, -0.013, 0.005 }, 0.4);
  const Shape both = { [&](const Point& at)
    {
      const double sheet = std::fabs(at[0] - plane) - 1e-12;
      return at[0] < -0.01 ? std::max(sheet, std::hypot(at[1], at[2]) - 0.8) : ball.Value(at);
    },
    {} };
  NarrowBand band(h);
  StartOn(band, both);
  EXPECT_EQ(GetTopology(Polygonise(band)).Components, 2) << "the sheet and the ball";
}
}
