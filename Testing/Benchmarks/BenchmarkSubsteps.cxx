// Errors of known motions against the number of substeps.
//
// Run: BenchmarkSubsteps [n, 64] [motion, all]
//
// n is the number of nodes along a side of [-1,1]^3, motion a part of the names of the motions to
// run. A ball with an exact solution of radius or centre moves
//
//   uniform speed: from 0.3 by 0.3, outward, on a target that is -1 everywhere
//   approach: from 0.3 to a ball of radius 0.55 at Attraction 1; the largest error in 40 frames
//   only tension: from 0.6 to 0.3
//   rest under tension: from 0.5 to (1 + sqrt(1 - 8 Tension / (Attraction R^2))) R / 2
//   lag: behind a target that moves 0.8 in a time of 1, at Attraction 10, 25 frames
//
// by substeps of CFL 1 and less. Columns: error of the mean radius (of the centre, for the lag) in
// voxels, its spread over the surface, substeps, milliseconds of processor time.

#include "Base/OpenVDB.h"
#include "Measuring.h"
#include "Scenes.h"
#include "Surface/Skin.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

using namespace activesurface;

namespace
{

/** Mean x and radius of the skin's points, and the spread of the radii. */
struct Measured
{
  double X = 0.0;
  double Radius = 0.0;
  double Spread = 0.0;
};

Measured Measure(const NarrowBand& band)
{
  const Skin skin(band);
  const std::size_t count = skin.GetNumberOfPoints();
  std::vector<double> points(3 * count);
  std::vector<std::int64_t> corners(3 * skin.GetNumberOfTriangles());
  skin.Write(points.data(), nullptr, corners.data());
  double low = HUGE_VAL, high = -HUGE_VAL, sum = 0.0, x[2] = { HUGE_VAL, -HUGE_VAL };
  for (std::size_t i = 0; i < count; ++i)
  {
    x[0] = std::min(x[0], points[3 * i]);
    x[1] = std::max(x[1], points[3 * i]);
  }
  const BallDistance fromCentre{ 0.0, .5 * (x[0] + x[1]) };
  for (std::size_t i = 0; i < count; ++i)
  {
    const double radius = fromCentre(points.data() + 3 * i);
    low = std::min(low, radius);
    high = std::max(high, radius);
    sum += radius;
  }
  return { fromCentre.X, sum / count, high - low };
}

class Uniform : public Target
{
public:
  void Evaluate(std::size_t count, const double*, const TargetResults& results) const override
  {
    std::fill_n(results.Values, count, -1.0);
    std::fill_n(results.Slopes, count, 0.0);
  }
};

class PassingBall : public FormulaTarget<BallDistance>
{
public:
  PassingBall()
    : FormulaTarget<BallDistance>(BallDistance{ .35, -.4 })
  {
  }
  void MoveTo(double time) override { this->Form.X = -.4 + .8 * time; }
};

struct Journey
{
  std::string Name;
  BallDistance Start;
  double Attraction;
  double Tension;
  double Time;
  int Frames;
  std::function<double(double, const Measured&)> Error; //< error at a time
  bool IsLargest = false;                               //< the largest error of all frames counts
};

struct Line
{
  std::size_t Substeps = 0;
  double Seconds = 0.0;
  double Error = 0.0;
  double Spread = 0.0;
};

Line Go(const Journey& journey, Target& target, int n, Motion motion)
{
  Line line;
  NarrowBand band(VoxelSizeOf(n));
  band.SetNumberOfThreads(1);
  band.Start(0.0, Box, MakeInitial(journey.Start));
  motion.Attraction = journey.Attraction;
  motion.Tension = journey.Tension;
  for (int frame = 1; frame <= journey.Frames; ++frame)
  {
    const double time = journey.Time * frame / journey.Frames;
    line.Seconds +=
      SecondsOf([&] { line.Substeps += band.Advance(time, motion, target).Substeps; });
    if (journey.IsLargest || frame == journey.Frames)
    {
      const Measured measured = Measure(band);
      const double error = journey.Error(time, measured) / band.GetVoxelSize();
      line.Error = std::fabs(error) > std::fabs(line.Error) ? error : line.Error;
      line.Spread = std::max(line.Spread, measured.Spread / band.GetVoxelSize());
    }
  }
  return line;
}

void PrintLines(const Journey& journey, Target& target, int n, const std::string& wanted)
{
  if (journey.Name.find(wanted) == std::string::npos)
  {
    return;
  }
  for (const double cfl : { 1.0, .5, .25, .125 })
  {
    Motion motion;
    motion.CFL = cfl;
    const Line line = Go(journey, target, n, motion);
    std::printf("%-20s %6.3f %10.4f %10.3f %9zu %9.0f\n", journey.Name.c_str(), cfl, line.Error,
      line.Spread, line.Substeps, 1000.0 * line.Seconds);
    std::fflush(stdout);
  }
}

}

int main(int argc, char** argv)
{
  openvdb::initialize();
  const int n = argc > 1 ? std::atoi(argv[1]) : 64;
  const std::string wanted = argc > 2 ? argv[2] : "";
  std::printf("n = %d\n%-20s %6s %10s %10s %9s %9s\n", n, "motion", "CFL", "error [h]",
    "spread [h]", "number", "ms");
  WithThreads(1,
    [&]
    {
      const auto radiusIs = [](double expected)
      { return [expected](double, const Measured& is) { return is.Radius - expected; }; };
      Uniform uniform;
      FormulaTarget<BallDistance> ball({ .55 }), smaller({ .5 });
      PassingBall passing;
      PrintLines({ "uniform speed", { .3 }, 1.0, 0.0, .3, 1, radiusIs(.6) }, uniform, n, wanted);
      PrintLines(
        { "approach", { .3 }, 1.0, 0.0, 4.0, 40,
          [](double time, const Measured& is) { return is.Radius - .55 + .25 * std::exp(-time); },
          true },
        ball, n, wanted);
      PrintLines({ "only tension", { .6 }, 0.0, 1.0, .0675, 1, radiusIs(.3) }, ball, n, wanted);
      const double rest = .25 * (1.0 + std::sqrt(1.0 - 8.0 * .015 / .25));
      PrintLines(
        { "rest under tension", { .5 }, 1.0, .015, 14.0, 1, radiusIs(rest) }, smaller, n, wanted);
      PrintLines({ "lag", { .35, -.4 }, 10.0, 0.0, 1.0, 25,
                   [](double time, const Measured& is)
                   { return is.X - (-.4 + .8 * time - .08 * (1.0 - std::exp(-10.0 * time))); } },
        passing, n, wanted);
    });
}
