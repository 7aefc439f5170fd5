// A skin splits during the motion from one function to another, at the predicted time.

#include "Support/HistoryTools.h"
#include "Support/PipelineTools.h"
#include "Support/ShapeFunction.h"

#include "vtkPolyData.h"
#include "vtkSphere.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

using namespace activesurface;

namespace TestTearing
{

namespace
{

// A ball of radius 0.5 at the origin moves to another shape, and splits when its surface reaches
// the origin. By symmetry the surface arrives there along a straight line, where the distance to
// the target is largest. The time is the integral of 1 / (Attraction * distance).
struct Metamorphosis
{
  Shape End;
  std::function<double(double)> DistanceAt; // to the target, at this distance from the origin
  std::string Before, After;

  double GetTime() const
  {
    constexpr int count = 1000;
    double time = 0.0;
    for (int i = 0; i < count; ++i)
    {
      time += 0.5 / count / this->DistanceAt(0.5 * (i + 0.5) / count);
    }
    return time;
  }
};

// The tolerance is the time in which the skin moves two voxels: thinner sheets are not resolved.
void IsTornInTime(const Metamorphosis& metamorphosis, double voxelSize)
{
  vtkNew<vtkSphere> start;
  vtkNew<vtkActiveImplicitSurface> filter;
  filter->SetInitialFunction(start);
  filter->SetTargetFunction(MakeFunction(metamorphosis.End));
  filter->SetModelBounds(-1.0, 1.0, -1.0, 1.0, -1.0, 1.0);
  filter->NormalizeTargetOff(); // distances, without a gradient on the path
  filter->SetVoxelSize(voxelSize);
  filter->SetTimeStepSize(0.05);
  filter->SetNumberOfTimeSteps(71);
  const double time = metamorphosis.GetTime();
  const double margin = 2.0 * voxelSize / metamorphosis.DistanceAt(0.0);
  EXPECT_LT(time + margin, 3.5) << "time when it is done";
  for (int step = 0; step <= 70; ++step)
  {
    const double now = 0.05 * step;
    const std::string name = " at " + std::to_string(now) + " of " + std::to_string(time);
    filter->UpdateTimeStep(now);
    const Mesh mesh = GetMesh(filter->GetOutput());
    EXPECT_EQ(CountDefects(mesh), 0u) << "defects" << name;
    const std::string row = DescribeTopology(filter, step);
    EXPECT_EQ(row, DescribeTopology(mesh)) << "the history's and the mesh's" << name;
    if (std::abs(now - time) > margin)
    {
      EXPECT_EQ(row, now < time ? metamorphosis.Before : metamorphosis.After) << "it is" << name;
    }
  }
}

}

TEST(TestTearing, BallBecomesATorusInTime)
{
  const auto distance = [](double height) { return std::hypot(0.5, height) - 0.22; };
  for (const double voxelSize : { 0.05, 0.025 })
  {
    IsTornInTime(
      { MakeTorus({ 0.0, 0.0, 0.0 }, 0.5, 0.22), distance, "1 0 2", "1 0 0" }, voxelSize);
  }
}

TEST(TestTearing, BallBecomesTwoInTime)
{
  const auto distance = [](double aside) { return std::hypot(0.45, aside) - 0.3; };
  const Shape balls = MakeBalls({ { { -0.45, 0.0, 0.0 }, 0.3 }, { { 0.45, 0.0, 0.0 }, 0.3 } });
  for (const double voxelSize : { 0.05, 0.025 })
  {
    IsTornInTime({ balls, distance, "1 0 2", "2 0 4" }, voxelSize);
  }
}

}
