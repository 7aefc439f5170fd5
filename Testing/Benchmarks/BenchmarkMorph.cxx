// A whole metamorphosis compared with OpenVDB's LevelSetMorphing: ball to torus, mesh to mesh.
//
// Run: BenchmarkMorph [quick]
//
// Both sides compute the same motion. LevelSetMorphing moves its grid by (phi - target) |grad phi|.
// At the surface, where phi is 0, this is our Attraction 1 to the target's distance. Neither side
// clamps the distance. Both advance in intervals of 0.5 up to time 10, when exp(-10) of the
// distance remains. After each interval, the benchmark measures the mean distance of the surface's
// points (crossings of the lattice's edges) to the target; this time does not count. All
// contestants reach the largest of their best errors: `to the same error` is the time until then.
//
// Making OpenVDB's two inputs does not count: its start, and the target's distances on a grid as
// wide as the motion of the band (MorphScenes.h). Evaluating our target counts. Steps are OpenVDB's
// iterations and our substeps. One thread.

#include "Crossings.h"
#include "Measuring.h"
#include "MorphScenes.h"
#include "NarrowBandGrid.h"
#include "OpenVDBSchemes.h"
#include "Scenes.h"

#include <algorithm>
#include <cmath>

using namespace activesurface;

namespace
{
constexpr double Piece = 0.5;
constexpr int Pieces = 20;

/** Results after each interval. */
struct Course
{
  std::vector<double> Seconds; //< since the start
  std::vector<double> Errors;
  std::vector<double> Steps;
};

double ErrorOf(const openvdb::FloatGrid& grid, const Target& target)
{
  const std::vector<double> points = FindCrossings(grid, 1.0);
  const std::size_t count = points.size() / 3;
  std::vector<double> values(count);
  std::vector<double> slopes(count);
  target.Evaluate(count, points.data(), { values.data(), slopes.data() });
  double sum = 0.0;
  for (const double value : values)
  {
    sum += std::fabs(value);
  }
  return sum / count;
}

/** `advance(begin, end)` returns its number of steps. */
template <class Advance, class Measure>
Course Follow(const Advance& advance, const Measure& measure)
{
  Course course;
  double seconds = 0.0;
  double steps = 0.0;
  for (int i = 0; i < Pieces; ++i)
  {
    seconds += SecondsOf([&] { steps += advance(i * Piece, (i + 1) * Piece); });
    course.Seconds.push_back(seconds);
    course.Steps.push_back(steps);
    course.Errors.push_back(measure());
  }
  return course;
}

Course FollowOurs(const MorphScene& scene)
{
  NarrowBand band(1.0);
  band.SetNumberOfThreads(1);
  band.Start(0.0, scene.Bounds, scene.Initial);
  Motion motion = MakeMotion(1.0, 0.0);
  return Follow([&](double, double end) { return band.Advance(end, motion, *scene.Goal).Substeps; },
    [&] { return ErrorOf(*GetPotential(band), *scene.Goal); });
}

Course FollowTheirs(const MorphScene& scene, bool isCheapest)
{
  const openvdb::FloatGrid::Ptr grid = scene.Source->deepCopy();
  openvdb::tools::LevelSetMorphing<openvdb::FloatGrid> morphing(*grid, *scene.GoalGrid);
  ChooseScheme(morphing, isCheapest);
  return Follow([&](double begin, double end)
    { return morphing.advect(static_cast<float>(begin), static_cast<float>(end)); },
    [&] { return ErrorOf(*grid, *scene.Goal); });
}

/** Index of the first interval with at most this error. */
std::size_t FindEnd(const Course& course, double error)
{
  std::size_t i = 0;
  while (course.Errors[i] > error)
  {
    ++i;
  }
  return i;
}

/** Largest of the contestants' best errors, which all of them reach. */
double FindCommonError(const std::vector<std::vector<Course>>& all)
{
  double common = 0.0;
  for (const std::vector<Course>& courses : all)
  {
    const Costs& errors = courses[0].Errors;
    common = std::max(common, *std::min_element(errors.begin(), errors.end()));
  }
  return common;
}

Costs SecondsAfter(const std::vector<Course>& courses, std::size_t piece)
{
  Costs seconds;
  for (const Course& course : courses)
  {
    seconds.push_back(course.Seconds[piece]);
  }
  return seconds;
}

void TellCourses(const Work& work, const std::vector<std::vector<Course>>& all)
{
  const std::vector<std::string> names = { "morph", NameOf(Default), NameOf(Cheapest) };
  const double common = FindCommonError(all);
  Tell(work, "the same error", "voxels", { common });
  std::vector<Costs> whole;
  std::vector<Costs> same;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    const Course& first = all[i][0];
    const std::size_t end = FindEnd(first, common);
    whole.push_back(SecondsAfter(all[i], Pieces - 1));
    same.push_back(SecondsAfter(all[i], end));
    Tell(work, names[i] + ", to the same error", "s", same[i]);
    Tell(work, names[i] + ", to time 10", "s", whole[i]);
    Tell(work, names[i] + ", steps", "", { first.Steps[end] });
    Tell(work, names[i] + ", steps to time 10", "", { first.Steps.back() });
    Tell(work, names[i] + ", error at time 10", "voxels", { first.Errors.back() });
  }
  for (std::size_t i = 1; i < all.size(); ++i)
  {
    TellRatio(work, names[0] + " over " + names[i], same[i], same[0]);
    TellRatio(work, names[0] + " to time 10 over " + names[i], whole[i], whole[0]);
  }
}

void Compare(const MorphScene& scene, int repetitions)
{
  std::vector<std::vector<Course>> all(3);
  for (int repetition = 0; repetition < repetitions; ++repetition)
  {
    all[0].push_back(FollowOurs(scene));
    all[1].push_back(FollowTheirs(scene, Default));
    all[2].push_back(FollowTheirs(scene, Cheapest));
  }
  TellCourses({ "morph", scene.Name, 1 }, all);
}
}

int main(int argc, char** argv)
{
  openvdb::initialize();
  const bool isQuick = IsQuick(argc, argv);
  WithThreads(1,
    [&]
    {
      for (const double radius : isQuick ? Costs{ 24 } : Costs{ 32, 64, 128 })
      {
        Compare(MakeBallToTorus(radius), isQuick ? 2 : 1);
      }
      Compare(MakeMeshToMesh(isQuick ? 24 : 64), isQuick ? 2 : 1);
    });
}
