// GetSkinFunction: the skin as an implicit function, for use in any other filter.

#include "Support/HistoryTools.h"
#include "Support/MessageCapture.h"
#include "Support/PipelineTools.h"
#include "Support/RandomShapes.h"
#include "Support/ShapeFunction.h"

#include "vtkClipPolyData.h"
#include "vtkCutter.h"
#include "vtkImplicitFunction.h"
#include "vtkMassProperties.h"
#include "vtkPlaneSource.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSelectEnclosedPoints.h"
#include "vtkTriangleFilter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <thread>
#include <vector>

using namespace activesurface;

namespace TestSkinFunction
{

namespace
{

constexpr double Pi = 3.14159265358979323846;
constexpr double VoxelSize = 0.0625; // voxel size of MakeShrinkingBall

double ValueAt(vtkImplicitFunction* function, double x, double y = 0.0, double z = 0.0)
{
  double place[3] = { x, y, z };
  return function->EvaluateFunction(place);
}

// Radius of the ball that has the volume in the last row of the history.
double GetRadius(vtkActiveImplicitSurface* filter)
{
  const double volume = GetNumber(filter, CountRows(filter) - 1, "Volume");
  return std::cbrt(3.0 * volume / (4.0 * Pi));
}

// The function is zero at the skin's radius, up to the sagitta h^2 / 8 r = 0.02 h. One voxel away
// it deviates from the distance by about h^2 / 2 r = 0.08 h.
void IsTheBall(vtkImplicitFunction* function, double radius, const std::string& name)
{
  for (const double offset : { -1.0, 0.0, 1.0 })
  {
    const double x = radius + offset * VoxelSize;
    EXPECT_NEAR(ValueAt(function, x) / VoxelSize, offset, offset == 0.0 ? 0.04 : 0.12)
      << "value [h] at " << offset << " h off the skin, " << name;
  }
  EXPECT_NEAR(ValueAt(function, 0.0), -3.0 * VoxelSize, 1e-12) << "value within, " << name;
  EXPECT_NEAR(ValueAt(function, 5.0), 3.0 * VoxelSize, 1e-12) << "value without, " << name;
}

void IsOutside(vtkImplicitFunction* function, const std::string& name)
{
  for (const double x : { -0.7, 0.0, 0.3, 0.6, 100.0 })
  {
    EXPECT_GT(ValueAt(function, x), 0.0) << "value at " << x << ", " << name;
  }
}

}

TEST(TestSkinFunction, SkinFunctionIsOneObject)
{
  auto filter = MakeShrinkingBall();
  vtkImplicitFunction* function = filter->GetSkinFunction();
  EXPECT_TRUE(function != nullptr) << "it is there before the first update";
  filter->UpdateTimeStep(0.3);
  EXPECT_TRUE(filter->GetSkinFunction() == function) << "after an update";
  filter->SetTension(0.01);
  EXPECT_TRUE(filter->GetSkinFunction() == function) << "after a change";
  filter->SetTension(-1.0);
  filter->SetCFL(0.0);
  MessageCapture messages(filter);
  filter->Update();
  EXPECT_TRUE(filter->GetSkinFunction() == function) << "after an error";
  EXPECT_GT(double(messages.Errors.size()), 0.0) << "which there was";
}

TEST(TestSkinFunction, SkinFunctionIsThatOfTheLastUpdate)
{
  auto filter = MakeShrinkingBall();
  vtkImplicitFunction* function = filter->GetSkinFunction();
  IsOutside(function, "before the first update");
  vtkMTimeType changed = function->GetMTime();
  double radius = 1.0;
  for (const double time : { 0.0, 0.5, 1.0 })
  {
    filter->UpdateTimeStep(time);
    const std::string name = "at " + std::to_string(time);
    EXPECT_LT(GetRadius(filter), radius - 0.5 * VoxelSize) << "radius, " << name;
    radius = GetRadius(filter);
    EXPECT_LT(double(changed), double(function->GetMTime())) << "MTime before and now, " << name;
    changed = function->GetMTime();
    IsTheBall(function, radius, name);
  }
  filter->UpdateTimeStep(1.0);
  EXPECT_EQ(function->GetMTime(), changed) << "MTime after an update that does nothing";
  filter->UpdateTimeStep(0.0);
  IsTheBall(function, 0.6, "back at 0");
}

// A later request returns the present skin.
TEST(TestSkinFunction, SkinFunctionMayBeAskedForLater)
{
  auto filter = MakeShrinkingBall();
  filter->UpdateTimeStep(0.5);
  IsTheBall(filter->GetSkinFunction(), GetRadius(filter), "at a step");
  auto between = MakeShrinkingBall();
  between->UpdateTimeStep(0.55);
  const double radius = 0.5 * (GetSkinBounds(between)[1] - GetSkinBounds(between)[0]);
  IsTheBall(between->GetSkinFunction(), radius, "between two steps");
}

TEST(TestSkinFunction, SkinFunctionIsOutsideAfterAnError)
{
  auto filter = MakeShrinkingBall();
  vtkImplicitFunction* function = filter->GetSkinFunction();
  filter->UpdateTimeStep(0.5);
  const double radius = GetRadius(filter);
  const vtkMTimeType changed = function->GetMTime();
  MessageCapture messages(filter);
  filter->SetCFL(0.0);
  filter->UpdateTimeStep(0.5);
  EXPECT_GT(double(messages.Errors.size()), 0.0) << "errors";
  IsOutside(function, "after an error");
  EXPECT_LT(double(changed), double(function->GetMTime())) << "MTime before and after the error";
  filter->SetCFL(1.0);
  filter->UpdateTimeStep(0.5);
  IsTheBall(function, radius, "after the correction");
}

// After a change, UpdateInformation discards the state, so the function has no skin.
TEST(TestSkinFunction, SkinFunctionAfterAChangeIsOutside)
{
  auto filter = MakeShrinkingBall();
  filter->UpdateTimeStep(0.55);
  filter->SetTension(0.01);
  filter->UpdateInformation();
  vtkImplicitFunction* function = filter->GetSkinFunction();
  IsOutside(function, "before the update");
  filter->UpdateTimeStep(0.5);
  IsTheBall(function, GetRadius(filter), "after it");

  auto source = MakeMovingBall();
  auto fed = MakeSkinOver(source);
  fed->UpdateTimeStep(1.0);
  source->Modified();
  fed->UpdateInformation();
  IsOutside(fed->GetSkinFunction(), "of an input that has changed");
}

TEST(TestSkinFunction, SkinFunctionOutlivesTheFilter)
{
  vtkSmartPointer<vtkImplicitFunction> function;
  {
    auto filter = MakeShrinkingBall();
    filter->Update();
    function = filter->GetSkinFunction();
  }
  IsTheBall(function, 0.6, "alone");
}

namespace
{

// A ball that becomes a torus, during the motion.
vtkSmartPointer<vtkActiveImplicitSurface> MakeTorusSkin()
{
  auto filter = vtkSmartPointer<vtkActiveImplicitSurface>::New();
  filter->SetInitialFunction(MakeFunction(MakeBall({ 0.0, 0.0, 0.0 }, 0.6)));
  filter->SetTargetFunction(MakeFunction(MakeTorus({ 0.01, 0.02, 0.013 }, 0.55, 0.22)));
  filter->SetModelBounds(-1.0, 1.0, -1.0, 1.0, -1.0, 1.0);
  filter->SetVoxelSize(0.05);
  filter->SetTimeStepSize(1.0);
  filter->UpdateTimeStep(5.0);
  return filter;
}

vtkSmartPointer<vtkPoints> DrawPoints(int count)
{
  RandomShapes random(41);
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  for (int i = 0; i < count; ++i)
  {
    const double x = random.DrawBetween(-1.0, 1.0);
    const double y = random.DrawBetween(-1.0, 1.0);
    points->InsertNextPoint(x, y, random.DrawBetween(-1.0, 1.0));
  }
  return points;
}

// Finds the points within a skin by rays through its triangles.
vtkSmartPointer<vtkSelectEnclosedPoints> Enclose(vtkPoints* points, vtkPolyData* skin)
{
  vtkNew<vtkPolyData> cloud;
  cloud->SetPoints(points);
  auto enclosed = vtkSmartPointer<vtkSelectEnclosedPoints>::New();
  enclosed->SetInputData(cloud);
  enclosed->SetSurfaceData(skin);
  enclosed->SetTolerance(1e-9);
  enclosed->Update();
  return enclosed;
}

}

// Within a voxel the trilinear surface and the triangles differ by the sagitta of its diagonal, 3
// h^2 / 8 r = 0.085 h for the tube's radius of 4.4 h. The mean difference is the sagitta of the
// voxel's side, 0.03 h.
TEST(TestSkinFunction, SkinFunctionHasTheSidesOfTheMesh)
{
  constexpr int count = 100000;
  auto filter = MakeTorusSkin();
  vtkImplicitFunction* function = filter->GetSkinFunction();
  const auto points = DrawPoints(count);
  const auto enclosed = Enclose(points, filter->GetOutput());
  int near = 0, far = 0, inside = 0;
  for (int i = 0; i < count; ++i)
  {
    double place[3];
    points->GetPoint(i, place);
    const double value = function->EvaluateFunction(place);
    const bool differs = (value < 0.0) != (enclosed->IsInside(i) != 0);
    inside += value < 0.0 ? 1 : 0;
    far += differs && std::abs(value) > 0.1 * 0.05 ? 1 : 0;
    near += differs ? 1 : 0;
  }
  const int last = CountRows(filter) - 1;
  const double expected = count * GetNumber(filter, last, "Volume") / 8.0;
  EXPECT_EQ(far, 0) << "points on other sides farther than .1 voxel from the skin";
  EXPECT_LT(near, count * GetNumber(filter, last, "Area") * 0.03 * 0.05 / 8.0)
    << "points on other sides";
  EXPECT_NEAR(inside, expected, 5.0 * std::sqrt(expected))
    << "points inside, within five deviations";
}

TEST(TestSkinFunction, SkinFunctionCanBeUsedByThreads)
{
  constexpr int count = 20000;
  auto filter = MakeTorusSkin();
  vtkImplicitFunction* function = filter->GetSkinFunction();
  const auto points = DrawPoints(count);
  const auto evaluate = [function, &points](std::vector<double>& values)
  {
    for (int i = 0; i < count; ++i)
    {
      double place[3], gradient[3];
      points->GetPoint(i, place);
      values[4 * i] = function->EvaluateFunction(place);
      function->EvaluateGradient(place, gradient);
      std::copy(gradient, gradient + 3, values.begin() + 4 * i + 1);
    }
  };
  // The threads run first: one of them has to prepare the function for all.
  std::array<std::vector<double>, 4> all;
  std::vector<std::thread> threads;
  for (std::vector<double>& values : all)
  {
    values.resize(4 * count);
    threads.emplace_back([&values, &evaluate] { evaluate(values); });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  std::vector<double> alone(4 * count);
  evaluate(alone);
  for (const std::vector<double>& values : all)
  {
    EXPECT_TRUE(values == alone) << "the values of a single thread";
  }
}

// Both skins have voxels of the same size, so they deviate by the sagitta of the target's trilinear
// cells, 0.02 h.
TEST(TestSkinFunction, SkinFunctionCanBeATarget)
{
  auto first = MakeTorusSkin();
  vtkNew<vtkActiveImplicitSurface> second;
  second->SetInitialFunction(MakeFunction(MakeBall({ 0.0, 0.0, 0.0 }, 0.8)));
  second->SetTargetFunction(first->GetSkinFunction());
  second->SetModelBounds(-1.0, 1.0, -1.0, 1.0, -1.0, 1.0);
  second->SetVoxelSize(0.05);
  second->SetTimeStepSize(12.0);
  const auto deviation = [&first, &second]
  {
    second->UpdateTimeStep(12.0);
    const Mesh mesh = GetMesh(second->GetOutput());
    double sum = 0.0;
    for (std::size_t i = 0; i < mesh.GetNumberOfPoints(); ++i)
    {
      const Point place = mesh.GetPoint(i);
      sum += std::abs(ValueAt(first->GetSkinFunction(), place[0], place[1], place[2]));
    }
    return sum / 0.05 / double(mesh.GetNumberOfPoints());
  };
  EXPECT_LT(deviation(), 0.05) << "mean distance of the skins [h]";
  EXPECT_EQ(DescribeTopology(second, 1), "1 0 0") << "bodies, voids, Euler number";
  first->UpdateTimeStep(0.0); // a ball of 0.6
  EXPECT_LT(deviation(), 0.05) << "mean distance of the skins [h], the first one restarted";
  EXPECT_EQ(DescribeTopology(second, 1), "1 0 2") << "bodies, voids, Euler number";
}

// A plane through the centre cuts out a disc of the ball's radius, and its circle. The skin's cells
// add a sagitta of h^2 / 8 r = 0.0008, and the plane's cells of 0.02 a sagitta of 0.0001.
TEST(TestSkinFunction, SkinFunctionCutsAndClips)
{
  auto filter = MakeShrinkingBall();
  filter->Update();
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(-1.0, -1.0, 0.0);
  plane->SetPoint1(1.0, -1.0, 0.0);
  plane->SetPoint2(-1.0, 1.0, 0.0);
  plane->SetResolution(100, 100);
  vtkNew<vtkClipPolyData> clip;
  clip->SetInputConnection(plane->GetOutputPort());
  clip->SetClipFunction(filter->GetSkinFunction());
  clip->InsideOutOn();
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputConnection(clip->GetOutputPort());
  vtkNew<vtkMassProperties> mass;
  mass->SetInputConnection(triangles->GetOutputPort());
  EXPECT_NEAR(std::sqrt(mass->GetSurfaceArea() / Pi), 0.6, 0.0017) << "radius of the disc's area";

  vtkNew<vtkCutter> cut;
  cut->SetInputConnection(plane->GetOutputPort());
  cut->SetCutFunction(filter->GetSkinFunction());
  cut->Update();
  EXPECT_GT(cut->GetOutput()->GetNumberOfPoints(), 100) << "points of the circle";
  double farthest = 0.0;
  for (vtkIdType i = 0; i < cut->GetOutput()->GetNumberOfPoints(); ++i)
  {
    const double* p = cut->GetOutput()->GetPoint(i);
    farthest = std::max(farthest, std::abs(std::hypot(p[0], p[1]) - 0.6));
  }
  EXPECT_LT(farthest, 0.0017) << "largest distance of the circle from the ball";

  filter->UpdateTimeStep(1.0);
  mass->Update();
  EXPECT_NEAR(std::sqrt(mass->GetSurfaceArea() / Pi), GetRadius(filter), 0.0025)
    << "radius of the disc's area, of the next skin";
}

}
