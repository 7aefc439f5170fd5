// Accuracy of tension against the resolution and the time step.
//
// Run: BenchmarkConvergence [largest n, 128] [factor, all]
//
// A ball of radius 0.6 in [-1,1]^3, n nodes along a side, shrinks by tension only to radius 0.3.
// Exact: r^2 = r0^2 - 4 Tension t. The substep is factor * h^2 / Tension. Columns:
//
//   error: of the mean radius, relative to 0.3 [%]
//
//   skin: the same error for the skin of an exact ball of radius 0.3. By linear interpolation of
//   the distance, the skin's points are h^2 / 24 r^2 too near on average. The error of the motion
//   is the difference
//
//   spread: largest minus least radius [h]
//
//   order: log of the ratio of the errors over log of the ratio of the voxel sizes, from the line
//   above and from n = 32 to this line; 2 for a scheme of second order

#include "Base/OpenVDB.h"
#include "NarrowBand.h"
#include "Surface/Skin.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

using namespace activesurface;

namespace
{
constexpr double StartRadius = 0.6;
constexpr double EndRadius = 0.3;
// A point off all planes of symmetry of the lattice.
constexpr double Centre[3] = { 0.013, 0.007, -0.021 };

class NoTarget : public Target
{
public:
  void MoveTo(double) override {}

  void Evaluate(std::size_t count, const double*, const TargetResults& results) const override
  {
    std::fill_n(results.Values, count, 0.0);
    std::fill_n(results.Slopes, count, 0.0);
  }
};

template <class Coordinate>
double GetRadius(const Coordinate* point)
{
  double square = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    square += std::pow(point[axis] - Centre[axis], 2);
  }
  return std::sqrt(square);
}

InitialFunction MakeBall(double radius)
{
  InitialFunction ball;
  ball.Evaluate = [radius](std::size_t count, const double* points, double* values)
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      values[i] = GetRadius(points + 3 * i) - radius;
    }
  };
  return ball;
}

struct Radii
{
  double Error = 0.0; //< of the mean radius, relative to EndRadius
  double Spread = 0.0;
};

Radii MeasureRadii(const NarrowBand& band)
{
  const Skin skin(band);
  const std::size_t count = skin.GetNumberOfPoints();
  std::vector<double> points(3 * count);
  std::vector<std::int64_t> corners(3 * skin.GetNumberOfTriangles());
  skin.Write(points.data(), nullptr, corners.data());
  double sum = 0.0;
  double least = 1e30;
  double largest = 0.0;
  for (std::size_t i = 0; i < count; ++i)
  {
    const double radius = GetRadius(points.data() + 3 * i);
    sum += radius;
    least = std::min(least, radius);
    largest = std::max(largest, radius);
  }
  return { sum / count / EndRadius - 1.0, largest - least };
}

NarrowBand& StartOnBall(NarrowBand& band, double radius)
{
  const double box[6] = { -1.0, 1.0, -1.0, 1.0, -1.0, 1.0 };
  band.Start(0.0, box, MakeBall(radius));
  return band;
}

struct Line
{
  double VoxelSize = 0.0;
  Radii Exact;
  Radii Shrunk;
  std::size_t Substeps = 0;
  double Seconds = 0.0;
};

Line Shrink(int n, double factor)
{
  Line line;
  line.VoxelSize = 2.0 / (n - 1);
  NarrowBand band(line.VoxelSize);
  line.Exact = MeasureRadii(StartOnBall(band, EndRadius));
  StartOnBall(band, StartRadius);
  Motion motion;
  motion.Attraction = 0.0;
  motion.Tension = 1.0;
  motion.CFL = 4.0 * factor;
  NoTarget none;
  const auto begin = std::chrono::steady_clock::now();
  const double time = (StartRadius * StartRadius - EndRadius * EndRadius) / 4.0;
  line.Substeps = band.Advance(time, motion, none).Substeps;
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
  line.Seconds = spent.count();
  line.Shrunk = MeasureRadii(band);
  return line;
}

double GetOrder(const Line& coarse, const Line& fine)
{
  return std::log(std::abs(coarse.Shrunk.Error / fine.Shrunk.Error)) /
    std::log(coarse.VoxelSize / fine.VoxelSize);
}

void PrintLines(double factor, int largest)
{
  std::vector<Line> lines;
  for (int n = 32; n <= largest; n *= 2)
  {
    lines.push_back(Shrink(n, factor));
    const Line& line = lines.back();
    std::printf("%6.2f %4d %10.4f %10.4f %10.3f", factor, n, 100.0 * line.Shrunk.Error,
      100.0 * line.Exact.Error, line.Shrunk.Spread / line.VoxelSize);
    if (lines.size() > 1)
    {
      std::printf(
        " %6.2f %8.2f", GetOrder(lines[lines.size() - 2], line), GetOrder(lines.front(), line));
    }
    else
    {
      std::printf(" %6s %8s", "-", "-");
    }
    std::printf(" %9zu %8.1f\n", line.Substeps, line.Seconds);
    std::fflush(stdout);
  }
}
}

int main(int argc, char** argv)
{
  openvdb::initialize();
  const int largest = argc > 1 ? std::atoi(argv[1]) : 128;
  std::vector<double> factors = { 0.1, 0.15, 0.2, 0.25 };
  if (argc > 2)
  {
    factors = { std::atof(argv[2]) };
  }
  std::printf("%6s %4s %10s %10s %10s %6s %8s %9s %8s\n", "factor", "n", "error [%]", "skin [%]",
    "spread [h]", "order", "since 32", "substeps", "seconds");
  for (const double factor : factors)
  {
    PrintLines(factor, largest);
  }
}
