// What a substep costs: nanoseconds per active voxel, and memory, against the resolution.
//
// Run: BenchmarkSubstep [largest n]      (default 256; about a minute)
//
// A ball of radius .6 in [-1,1]^3, n nodes along a side. Columns, median (best) of the repetitions:
//
//   tension: tension alone
//
//   target: the default scheme, attraction and tension, to a moving ball whose distance is a
//   formula
//
//   openvdb: one step of OpenVDB's LevelSetFilter::meanCurvature on the same ball, half width 3,
//   with its own renormalisation and rebuilding, per active voxel of its own band
//
//   ratio: tension over openvdb
//
// Memory is the peak of the process so far: n grows, so each line's is that of its n.

#include "NarrowBand.h"

#include <openvdb/tools/LevelSetFilter.h>
#include <openvdb/tools/LevelSetSphere.h>

#include <tbb/global_control.h>

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <vector>

using namespace activesurface;

namespace
{
constexpr double Radius = 0.6;
constexpr int Repetitions = 7;

// Moves along x as fast as a tenth of a voxel per substep or more, so that nothing comes to rest.
class MovingBall : public Target
{
public:
  void MoveTo(double time) override { this->X = 0.1 * std::sin(3.0 * time); }

  void Evaluate(
    std::size_t count, const double* points, double* values, double* slopes) const override
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      const double x = points[3 * i] - this->X;
      const double y = points[3 * i + 1];
      const double z = points[3 * i + 2];
      values[i] = std::sqrt(x * x + y * y + z * z) - Radius;
      slopes[i] = 1.0;
    }
  }

private:
  double X = 0.0;
};

InitialFunction MakeBall()
{
  InitialFunction ball;
  ball.Evaluate = [](std::size_t count, const double* points, double* values)
  { MovingBall().Evaluate(count, points, values, std::vector<double>(count).data()); };
  return ball;
}

struct Timing
{
  double Median = 0.0;
  double Best = 0.0;
};

// Nanoseconds per unit of work; `repetition` returns how many units it did.
Timing Measure(const std::function<double()>& repetition)
{
  std::vector<double> costs;
  for (int i = 0; i < Repetitions; ++i)
  {
    const auto begin = std::chrono::steady_clock::now();
    const double work = repetition();
    const std::chrono::duration<double, std::nano> spent = std::chrono::steady_clock::now() - begin;
    costs.push_back(spent.count() / work);
  }
  std::sort(costs.begin(), costs.end());
  return { costs[costs.size() / 2], costs.front() };
}

// Enough to be timed, few enough to stay near the same number of voxels.
int GetSubsteps(int n)
{
  return std::max(4, 1280 / n);
}

Timing MeasureBand(int n, const Motion& motion, int threads)
{
  NarrowBand band(2.0 / (n - 1));
  band.SetNumberOfThreads(threads);
  const double box[6] = { -1.0, 1.0, -1.0, 1.0, -1.0, 1.0 };
  band.Start(0.0, box, MakeBall());
  MovingBall target;
  return Measure(
    [&]
    {
      const double voxels = static_cast<double>(band.GetNumberOfActiveNodes());
      int asked = 0;
      const auto enough = [&](double) { return asked++ < GetSubsteps(n); };
      return voxels * band.Advance(band.GetTime() + 1.0, motion, target, enough).Substeps;
    });
}

Motion MakeMotion(double attraction, double tension)
{
  Motion motion;
  motion.Attraction = attraction;
  motion.Tension = tension;
  return motion;
}

Timing MeasureOpenVDB(int n, int threads)
{
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  const float voxelSize = 2.f / (n - 1);
  const openvdb::FloatGrid::Ptr ball = openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(
    static_cast<float>(Radius), openvdb::Vec3f(0.f), voxelSize);
  openvdb::tools::LevelSetFilter<openvdb::FloatGrid> filter(*ball);
  return Measure(
    [&]
    {
      const double voxels = static_cast<double>(ball->activeVoxelCount());
      for (int i = 0; i < GetSubsteps(n); ++i)
      {
        filter.meanCurvature();
      }
      return voxels * GetSubsteps(n);
    });
}

double GetPeakMegabytes()
{
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss / 1024.0;
}

struct Costs
{
  int Threads;
  Timing Tension;
  Timing Target;
};

// OpenVDB comes last, so that the memory is ours.
void PrintLines(int n)
{
  std::vector<Costs> lines;
  for (const int threads : { 1, 2 })
  {
    lines.push_back({ threads, MeasureBand(n, MakeMotion(0.0, 1.0), threads),
      MeasureBand(n, MakeMotion(10.0, 0.001), threads) });
  }
  const double memory = GetPeakMegabytes();
  for (const Costs& line : lines)
  {
    const Timing openvdb = MeasureOpenVDB(n, line.Threads);
    std::printf("%4d %7d %9.1f (%6.1f) %9.1f (%6.1f) %9.1f (%6.1f) %8.2f %8.0f\n", n, line.Threads,
      line.Tension.Median, line.Tension.Best, line.Target.Median, line.Target.Best, openvdb.Median,
      openvdb.Best, line.Tension.Median / openvdb.Median, memory);
    std::fflush(stdout);
  }
}
}

int main(int argc, char** argv)
{
  openvdb::initialize();
  const int largest = argc > 1 ? std::atoi(argv[1]) : 256;
  std::printf("nanoseconds per active voxel and substep, median (best) of %d\n", Repetitions);
  std::printf("%4s %7s %18s %18s %18s %8s %8s\n", "n", "threads", "tension", "target", "openvdb",
    "ratio", "peak MiB");
  for (int n = 64; n <= largest; n *= 2)
  {
    PrintLines(n);
  }
}
