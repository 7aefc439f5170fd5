// A ball as it is started: area, volume, and how many nodes are kept for it.

#include "Check.h"
#include "RandomShapes.h"
#include "SurfaceMeasures.h"

#include <algorithm>
#include <cmath>
#include <string>

using namespace activesurface;

namespace
{
constexpr double Pi = 3.14159265358979323846;
constexpr double Radius = 0.6;

std::string Name(int n)
{
  return "n = " + std::to_string(n);
}

// The skin is inscribed. A right triangle with legs of one voxel h and corners on the sphere is
// behind it by h^2 / 6 r on average: the volume lacks h^2 / 2 r^2, .58 % at n = 32, the area half
// of that, and both a quarter for each doubling of n. Triangles along a voxel's diagonals are
// wider: 30 % more.
void CheckAreaAndVolume(
  Check& check, int n, const Ball& ball, double areaTolerance, double volumeTolerance)
{
  NarrowBand band(VoxelSizeOf(n));
  StartOn(band, MakeBall(ball.Centre, ball.Radius));
  const Mesh mesh = Polygonise(band);
  const double square = ball.Radius * ball.Radius;
  const double area = GetArea(mesh) / (4.0 * Pi * square);
  const double volume = GetVolume(mesh) / (4.0 / 3.0 * Pi * square * ball.Radius);
  check.Near(area, 1.0, areaTolerance, "area of the ball over the exact one, " + Name(n));
  check.Near(volume, 1.0, volumeTolerance, "volume of the ball over the exact one, " + Name(n));
}

void BallHasExactAreaAndVolume(Check& check)
{
  const Ball ball = { CentreA, Radius };
  CheckAreaAndVolume(check, 32, ball, 0.004, 0.0075);
  CheckAreaAndVolume(check, 64, ball, 0.001, 0.0018);
  CheckAreaAndVolume(check, 128, ball, 0.00025, 0.0005);
}

// The tolerances are for a radius of .6 or more: what lacks is proportional to h^2 / r^2, 23 % more
// at 10 % less radius, which is up to 15 % more than allowed.
Ball DrawBall(RandomShapes& random)
{
  const Point centre = random.DrawPointNear(CentreA);
  return { centre, random.DrawBetween(Radius, 1.1 * Radius) };
}

void BallHasExactAreaAndVolumeAtRandom(Check& check)
{
  RandomShapes random(1);
  for (int i = 0; i < 4; ++i)
  {
    CheckAreaAndVolume(check, 32, DrawBall(random), 0.004, 0.0075);
    CheckAreaAndVolume(check, 64, DrawBall(random), 0.001, 0.0018);
  }
  CheckAreaAndVolume(check, 128, DrawBall(random), 0.00025, 0.0005);
}

// The sample points lie on chords of the lattice's edges: linear interpolation of a distance along
// an edge errs by at most (1/8) (h^2 / r) < .01 h at n = 32. Float32 adds h * 1e-7.
void BallHasExactRadius(Check& check)
{
  for (const int n : { 32, 64 })
  {
    const double h = VoxelSizeOf(n);
    NarrowBand band(h);
    StartOn(band, MakeBall(CentreB, Radius));
    const Range radii = GetRadii(Polygonise(band), CentreB);
    const double tolerance = h / Radius / 8.0 + 1e-5;
    check.Near((radii.Minimum - Radius) / h, 0.0, tolerance, "least radius [h], " + Name(n));
    check.Near((radii.Maximum - Radius) / h, 0.0, tolerance, "largest radius [h], " + Name(n));
  }
}

// Layers of constant number around a surface: nodes ~ n^2. They are counted on a lattice: the
// curved ends of n/2 of their columns are off by a node or so, 1/n of the count and more of the
// outer ones.
void CheckNodes(Check& check, int n, const Ball& ball)
{
  NarrowBand band(VoxelSizeOf(n));
  StartOn(band, MakeBall(ball.Centre, ball.Radius));
  const double square = std::pow(n * ball.Radius / Radius, 2);
  const double active = band.GetNumberOfActiveNodes() / square;
  const double ghosts = band.GetNumberOfGhosts() / square;
  check.Near(active, 7.0, 0.05 * 7.0, "active nodes / n^2, " + Name(n));
  check.Near(ghosts, 3.8, 0.05 * 3.8, "ghosts / n^2, " + Name(n));
}

void NodesGrowWithTheSurfaceNotTheVolume(Check& check)
{
  for (const int n : { 32, 64, 128 })
  {
    CheckNodes(check, n, { CentreA, Radius });
  }
}

// A ring of ghosts at a distance of 3.5 h has 1 + (3.5 h / r)^2 times the ball's nodes: the
// constants are those of large balls, at n = 32 from .6 on.
void NodesGrowWithTheSurfaceNotTheVolumeAtRandom(Check& check)
{
  RandomShapes random(13);
  for (const int n : { 32, 32, 64, 64, 128 })
  {
    CheckNodes(check, n, DrawBall(random));
  }
}

// Large enough to be swept in several slabs. Central differences of a distance are 1 but for
// (h / r)^2, 2e-4.
void DistancesHaveNoSeams(Check& check)
{
  const double h = VoxelSizeOf(256);
  NarrowBand band(h);
  StartOn(band, MakeBall(CentreA, Radius));
  double largest = 0.0;
  for (auto node = band.GetPotential()->cbeginValueOn(); node; ++node)
  {
    double square = 0.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double x = h * node.getCoord()[axis] - CentreA[axis];
      square += x * x;
    }
    largest = std::max(largest, std::fabs(*node - (std::sqrt(square) - Radius) / h));
  }
  check.Less(400000, band.GetNumberOfActiveNodes(), "active nodes");
  check.Less(largest, 0.001, "largest error of a distance [h]");
}
}

int main(int argc, char** argv)
{
  return RunFacts(argc, argv,
    { { "BallHasExactAreaAndVolume", BallHasExactAreaAndVolume },
      { "BallHasExactAreaAndVolumeAtRandom", BallHasExactAreaAndVolumeAtRandom },
      { "BallHasExactRadius", BallHasExactRadius },
      { "DistancesHaveNoSeams", DistancesHaveNoSeams },
      { "NodesGrowWithTheSurfaceNotTheVolume", NodesGrowWithTheSurfaceNotTheVolume },
      { "NodesGrowWithTheSurfaceNotTheVolumeAtRandom",
        NodesGrowWithTheSurfaceNotTheVolumeAtRandom } });
}
