// A ball as it is started: area, volume, and how many nodes are kept for it.

#include "Check.h"
#include "SurfaceMeasures.h"

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
void CheckAreaAndVolume(Check& check, int n, double areaTolerance, double volumeTolerance)
{
  NarrowBand band(VoxelSizeOf(n));
  StartOn(band, MakeBall(CentreA, Radius));
  const Mesh mesh = Polygonise(band);
  const double area = GetArea(mesh) / (4.0 * Pi * Radius * Radius);
  const double volume = GetVolume(mesh) / (4.0 / 3.0 * Pi * Radius * Radius * Radius);
  check.Near(area, 1.0, areaTolerance, "area of the ball over the exact one, " + Name(n));
  check.Near(volume, 1.0, volumeTolerance, "volume of the ball over the exact one, " + Name(n));
}

void BallHasExactAreaAndVolume(Check& check)
{
  CheckAreaAndVolume(check, 32, 0.004, 0.0075);
  CheckAreaAndVolume(check, 64, 0.001, 0.0018);
  CheckAreaAndVolume(check, 128, 0.00025, 0.0005);
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
void NodesGrowWithTheSurfaceNotTheVolume(Check& check)
{
  for (const int n : { 32, 64, 128 })
  {
    NarrowBand band(VoxelSizeOf(n));
    StartOn(band, MakeBall(CentreA, Radius));
    const double square = n * n;
    const double active = band.GetNumberOfActiveNodes() / square;
    const double ghosts = band.GetNumberOfGhosts() / square;
    check.Near(active, 7.0, 0.05 * 7.0, "active nodes / n^2, " + Name(n));
    check.Near(ghosts, 3.8, 0.05 * 3.8, "ghosts / n^2, " + Name(n));
  }
}
}

int main(int argc, char** argv)
{
  return RunFacts(argc, argv,
    { { "BallHasExactAreaAndVolume", BallHasExactAreaAndVolume },
      { "BallHasExactRadius", BallHasExactRadius },
      { "NodesGrowWithTheSurfaceNotTheVolume", NodesGrowWithTheSurfaceNotTheVolume } });
}
