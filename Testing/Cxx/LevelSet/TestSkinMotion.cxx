// Curvature and speed at the vertices of the skin, compared with formulas and with a later skin.

#include "Support/SurfaceMeasures.h"

#include "Surface/SkinDistance.h"
#include "Surface/SkinMotion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace activesurface;

namespace TestSkinMotion
{

// The mean error is second order: at most (h / r)^2 of 2 / r.
TEST(TestSkinMotion, CurvatureOfABallIsTwoOverItsRadius)
{
  for (const int n : { 32, 64 })
  {
    const double h = VoxelSizeOf(n), radius = 0.6;
    NarrowBand band(h);
    StartOn(band, MakeBall(CentreA, radius));
    const std::vector<float> curvatures = FindCurvatures(band);
    const double tolerance = h * h / (radius * radius);
    double mean = 0.0, largest = 0.0;
    for (const float curvature : curvatures)
    {
      const double error = curvature * radius / 2.0 - 1.0;
      mean += error / double(curvatures.size());
      largest = std::max(largest, std::fabs(error));
    }
    EXPECT_EQ(curvatures.size(), Polygonise(band).GetNumberOfPoints()) << "one for each vertex";
    EXPECT_NEAR(mean, 0.0, tolerance) << "mean relative error, n = " << n;
    EXPECT_LT(largest, 4.0 * tolerance) << "largest relative error, n = " << n;
  }
}

struct Course
{
  const char* Name;
  Shape Start;
  ShapeTarget::Trajectory Path;
  Motion Way;
  double Begin; // time of the speed
};

// Compares the displacement of the skin in a short time with its speeds at the beginning. Within a
// tenth of a voxel the speed changes little.
void CheckSpeeds(const Course& course, int n)
{
  const double h = VoxelSizeOf(n);
  NarrowBand band(h);
  StartOn(band, course.Start);
  ShapeTarget target(course.Path);
  band.Advance(course.Begin, course.Way, target);
  const SkinForces forces = { course.Way, target, band.GetStartArea(), band.GetStartVolume() };
  const std::vector<float> speeds = FindSpeeds(band, forces);
  const Mesh mesh = Polygonise(band);
  double fastest = 0.0;
  for (const float speed : speeds)
  {
    fastest = std::max(fastest, std::fabs(double(speed)));
  }
  const double time = 0.1 * h / fastest;
  const auto later = band.Clone();
  later->Advance(course.Begin + time, course.Way, target);
  const SkinDistance distance(*later);
  double error = 0.0, way = 0.0;
  for (std::size_t v = 0; v < speeds.size(); ++v)
  {
    const Point point = mesh.GetPoint(v);
    const double moved = -distance.Evaluate(point.data(), nullptr);
    error += std::fabs(moved - speeds[v] * time);
    way += std::fabs(moved);
  }
  const std::string name = std::string(course.Name) + ", n = " + std::to_string(n);
  EXPECT_LT(0.02 * h, way / double(speeds.size())) << "mean path length, " << name;
  EXPECT_LT(error / way, 0.05) << "mean error over the mean path length, " << name;
}

// Motion with short substeps.
Motion MotionOf(double attraction, double tension)
{
  Motion motion = MakeMotion(attraction, tension);
  motion.CFL = 0.5;
  return motion;
}

// A ball with a steady lag behind a target in uniform motion.
Course MakeTranslation()
{
  const auto path = [](double time) { return MakeBall({ -0.3 + 0.4 * time, 0.013, -0.007 }, 0.4); };
  return { "translation", path(0.0), path, MotionOf(10.0, 0.0), 0.6 };
}

Course MakeGrowth()
{
  const auto path = [](double) { return MakeBall(CentreA, 0.7); };
  return { "growth", MakeBall(CentreA, 0.3), path, MotionOf(1.0, 0.02), 0.3 };
}

// The target is evaluated at other points than the skin's vertices.
Course MakeGrowthBy(TargetEvaluation evaluation, bool paper)
{
  Course course = MakeGrowth();
  course.Name = paper ? "growth by the paper's scheme" : "growth from values at nodes";
  course.Way.Evaluation = evaluation;
  course.Way.Paper = paper;
  return course;
}

// The course ends before the ball splits.
Course MakeSplit()
{
  const auto path = [](double) {
    return MakeBalls({ { { -0.43, 0.01, 0.02 }, 0.3 }, { { 0.45, 0.03, -0.01 }, 0.33 } });
  };
  return { "split", MakeBall({ 0.0, 0.0, 0.0 }, 0.5), path, MotionOf(1.0, 0.0), 0.4 };
}

Course MakeHeld()
{
  const auto path = [](double) { return MakeConstant(0.0); };
  Course course = { "constrained volume", MakeEllipsoid({ 0.7, 0.4, 0.3 }), path,
    MotionOf(0.0, 1.0), 0.003 };
  course.Way.VolumeControl = Control::Exact;
  return course;
}

Course MakeHeldArea()
{
  Course course = MakeHeld();
  course.Name = "held area";
  course.Way.VolumeControl = Control::None;
  course.Way.AreaControl = Control::Exact;
  return course;
}

Course MakePenalised()
{
  Course course = MakeHeld();
  course.Name = "penalised volume";
  course.Way.VolumeControl = Control::Penalty;
  course.Way.VolumeStiffness = 20.0;
  return course;
}

TEST(TestSkinMotion, SpeedIsThatOfTheSkin)
{
  for (const Course& course :
    { MakeTranslation(), MakeGrowth(), MakeGrowthBy(TargetEvaluation::Node, false),
      MakeGrowthBy(TargetEvaluation::ClosestPoint, false),
      MakeGrowthBy(TargetEvaluation::Shifted, true), MakeSplit(), MakeHeld(), MakeHeldArea(),
      MakePenalised() })
  {
    for (const int n : { 40, 64 })
    {
      CheckSpeeds(course, n);
    }
  }
}

TEST(TestSkinMotion, NothingHasNoSpeed)
{
  const NarrowBand band(0.1);
  ShapeTarget target(MakeConstant(0.0));
  EXPECT_EQ(FindCurvatures(band).size(), 0u) << "curvatures";
  EXPECT_EQ(FindSpeeds(band, { Motion(), target, 0.0, 0.0 }).size(), 0u) << "speeds";
}
}
