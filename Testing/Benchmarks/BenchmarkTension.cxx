// Cost of a substep, compared with OpenVDB's LevelSetFilter::meanCurvature: a ball of radius 0.6 in
// [-1,1]^3, n nodes along a side.
//
// Run: BenchmarkTension [quick]
//
// Costs are nanoseconds per substep and active voxel of the own band: our band is 6 voxels wide and
// has 7 n^2 active voxels, OpenVDB's of half width 3 has 6 to 7 n^2. Costs include all parts of a
// substep: in OpenVDB the step, renormalisation and the new band.
//
//   tension: tension only
//
//   default scheme: attraction to a moving ball, whose distance is a formula, and tension
//
// "shrinks to .3" is the same motion to the same time: the ball shrinks by a Tension of 1 only,
// exactly r^2 = 0.36 - 4 t, to r = 0.3. Prints the total seconds, and the final error of the mean
// radius of the crossings of the lattice's edges. OpenVDB's step is h^2 / 6 in units of this time,
// ours h^2 / 4.

#include "Crossings.h"
#include "Measuring.h"
#include "NarrowBandGrid.h"
#include "OpenVDBSchemes.h"
#include "Scenes.h"

#include <openvdb/tools/LevelSetSphere.h>

#include <cmath>
#include <cstdio>
#include <memory>

using namespace activesurface;

namespace
{
constexpr double StartRadius = 0.6;
constexpr double EndRadius = 0.3;

using LevelSetFilter = openvdb::tools::LevelSetFilter<openvdb::FloatGrid>;

openvdb::FloatGrid::Ptr MakeLevelSetBall(int n)
{
  return openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(
    static_cast<float>(StartRadius), openvdb::Vec3f(0.f), static_cast<float>(VoxelSizeOf(n)));
}

// Few substeps, so that the number of active voxels stays nearly constant.
int CountSubsteps(int n)
{
  return std::max(4, 1280 / n);
}

Contestant MakeOurs(const std::string& name, int n, const Motion& motion, int threads)
{
  auto band = std::make_shared<NarrowBand>(VoxelSizeOf(n));
  band->SetNumberOfThreads(threads);
  band->Start(0.0, Box, MakeInitial(BallDistance()));
  auto target = std::make_shared<MovingBall>();
  AdvanceSubsteps(*band, 2, motion, *target); // memory is allocated from here on
  return { name,
    [=]
    {
      const double voxels = static_cast<double>(band->GetNumberOfActiveNodes());
      const int substeps = CountSubsteps(n);
      const double seconds = SecondsOf([&] { AdvanceSubsteps(*band, substeps, motion, *target); });
      return 1e9 * seconds / (voxels * substeps);
    } };
}

Contestant MakeTheirs(int n, bool isCheapest)
{
  auto ball = MakeLevelSetBall(n);
  auto filter = std::make_shared<LevelSetFilter>(*ball);
  ChooseScheme(*filter, isCheapest);
  return { NameOf(isCheapest),
    [=]
    {
      const int steps = std::max(1, 128 / n);
      const double voxels = static_cast<double>(ball->activeVoxelCount());
      const double seconds = SecondsOf(
        [&]
        {
          for (int i = 0; i < steps; ++i)
          {
            filter->meanCurvature();
          }
        });
      return 1e9 * seconds / (voxels * steps);
    } };
}

void CompareSubsteps(int n, int threads, int repetitions)
{
  const std::vector<Contestant> contestants = {
    MakeOurs("tension", n, MakeMotion(0.0, 1.0), threads),
    MakeTheirs(n, Default),
    MakeTheirs(n, Cheapest),
    MakeOurs("default scheme", n, MakeMotion(10.0, 0.001), threads),
  };
  std::vector<Costs> costs;
  WithThreads(threads, [&] { costs = MeasureInTurns(contestants, repetitions); });
  const Work work = { "tension", "n = " + std::to_string(n), threads };
  for (std::size_t i = 0; i < contestants.size(); ++i)
  {
    Tell(work, contestants[i].Name, "ns", costs[i]);
  }
  TellRatio(work, "tension over OpenVDB, defaults", costs[1], costs[0]);
  TellRatio(work, "tension over OpenVDB, cheapest", costs[2], costs[0]);
}

double ErrorOfRadius(const openvdb::FloatGrid& grid, double voxelSize)
{
  double sum = 0.0;
  const std::vector<double> points = FindCrossings(grid, voxelSize);
  for (std::size_t i = 0; i < points.size(); i += 3)
  {
    sum += std::sqrt(
      points[i] * points[i] + points[i + 1] * points[i + 1] + points[i + 2] * points[i + 2]);
  }
  return 100.0 * std::fabs(3.0 * sum / points.size() / EndRadius - 1.0);
}

double ShrinkOurs(int n, double& error)
{
  NarrowBand band(VoxelSizeOf(n));
  band.SetNumberOfThreads(1);
  band.Start(0.0, Box, MakeInitial(BallDistance()));
  MovingBall none;
  const double time = (StartRadius * StartRadius - EndRadius * EndRadius) / 4.0;
  const double seconds = SecondsOf([&] { band.Advance(time, MakeMotion(0.0, 1.0), none); });
  error = ErrorOfRadius(*GetPotential(band), band.GetVoxelSize());
  return seconds;
}

double ShrinkTheirs(int n, bool isCheapest, double& error)
{
  const double h = VoxelSizeOf(n);
  const openvdb::FloatGrid::Ptr ball = MakeLevelSetBall(n);
  LevelSetFilter filter(*ball);
  ChooseScheme(filter, isCheapest);
  const double steps = (StartRadius * StartRadius - EndRadius * EndRadius) / (4.0 * h * h / 6.0);
  const double seconds = SecondsOf(
    [&]
    {
      for (int i = 0; i < std::lround(steps); ++i)
      {
        filter.meanCurvature();
      }
    });
  error = ErrorOfRadius(*ball, h);
  return seconds;
}

void CompareShrinking(int n, int repetitions)
{
  double errors[3] = { 0.0, 0.0, 0.0 };
  const std::vector<Contestant> contestants = {
    { "shrinks", [&] { return ShrinkOurs(n, errors[0]); } },
    { NameOf(Default), [&] { return ShrinkTheirs(n, Default, errors[1]); } },
    { NameOf(Cheapest), [&] { return ShrinkTheirs(n, Cheapest, errors[2]); } },
  };
  std::vector<Costs> costs;
  WithThreads(1, [&] { costs = MeasureInTurns(contestants, repetitions); });
  const Work work = { "tension", "shrinks to .3, n = " + std::to_string(n), 1 };
  TellContest(work, "s", contestants, costs);
  for (std::size_t i = 0; i < contestants.size(); ++i)
  {
    Tell(work, "error of " + contestants[i].Name, "% of radius", { errors[i] });
  }
}
}

int main(int argc, char** argv)
{
  openvdb::initialize();
  const bool isQuick = IsQuick(argc, argv);
  for (int n = 64; n <= (isQuick ? 128 : 512); n *= 2)
  {
    for (const int threads : ThreadsToMeasure())
    {
      CompareSubsteps(n, threads, isQuick ? 5 : 7);
    }
  }
  CompareShrinking(48, 3);
  if (!isQuick)
  {
    CompareShrinking(128, 1);
  }
}
