// Scenes of absurd size, far from the origin, or with absurd values: right, or refused at once.

#include "AnalyticShapes.h"
#include "Check.h"
#include "Skin.h"
#include "SurfaceMeasures.h"

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

using namespace activesurface;

namespace
{

// As a function has that is known within some box only, and says so by a huge number.
void HugeValuesFarFromTheSurfaceDoNotSpoilTheStart(Check& check)
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
    // Linear crossings of a distance are off by h^2 / (8 r) = h / 93 at most.
    check.Near(
      (radii.Mean - 0.6) / h, 0.0, 0.011, "error of the radius [h], " + std::to_string(huge));
    check.Less(radii.GetSpread() / h, 0.022, "spread of the radii [h], " + std::to_string(huge));
  }
}

void BoundsThatWouldTakeMinutesToSampleAreRefused(Check& check)
{
  NarrowBand band(0.05);
  band.SetMaximumNumberOfActiveVoxels(50000000);
  const double wide[6] = { -50.0, 50.0, -50.0, 50.0, -50.0, 50.0 };
  check.Throws<std::runtime_error>([&]
    { band.Start(0.0, wide, MakeInitialFunction(MakeBall(CentreA, 0.6))); },
    "too many", "2000^3 nodes are more than 40 * 50000000");
}

// 2^20 voxels from the origin single precision leaves sixteenths of a voxel.
void SkinFarFromTheOriginKeepsItsPrecision(Check& check)
{
  const double h = 0.0625, far = h * (1 << 20);
  const Point centre = { far + CentreA[0], CentreA[1], CentreA[2] };
  const double bounds[6] = { far - 1.0, far + 1.0, -1.0, 1.0, -1.0, 1.0 };
  NarrowBand band(h);
  band.Start(0.0, bounds, MakeInitialFunction(MakeBall(centre, 0.6)));
  const Skin skin(band);
  check.True(skin.NeedsDoublePrecision(), "it says so");
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
  check.Less(0, points.size(), "numbers");
  check.Less(largest / h, 0.02, "largest error of the radii [h]");

  NarrowBand near(h);
  StartOn(near, MakeBall(CentreA, 0.6));
  check.True(!Skin(near).NeedsDoublePrecision(), "single precision near the origin");
}

void AbsurdNumberOfThreadsIsCapped(Check& check)
{
  NarrowBand band(VoxelSizeOf(32));
  band.SetNumberOfThreads(2000000000);
  StartOn(band, MakeBall(CentreA, 0.5));
  ShapeTarget target(MakeBall(CentreA, 0.6));
  check.Less(0, band.Advance(0.5, Motion(), target).Substeps, "substeps");
}

}

int main(int argc, char** argv)
{
  return RunFacts(argc, argv,
    { { "HugeValuesFarFromTheSurfaceDoNotSpoilTheStart",
        HugeValuesFarFromTheSurfaceDoNotSpoilTheStart },
      { "BoundsThatWouldTakeMinutesToSampleAreRefused",
        BoundsThatWouldTakeMinutesToSampleAreRefused },
      { "SkinFarFromTheOriginKeepsItsPrecision", SkinFarFromTheOriginKeepsItsPrecision },
      { "AbsurdNumberOfThreadsIsCapped", AbsurdNumberOfThreadsIsCapped } });
}
