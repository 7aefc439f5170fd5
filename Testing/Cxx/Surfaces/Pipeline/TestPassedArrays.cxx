// Data that the skin gets from the particles under it: their arrays, and their velocity along the
// skin.

#include "Support/GrainTools.h"
#include "Support/MessageCapture.h"
#include "Support/PipelineTools.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSkeletonPotential.h"
#include "vtkStringArray.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace activesurface;

namespace TestPassedArrays
{

// The sum of the weights is 1 up to rounding, and the array has single precision.
TEST(TestPassedArrays, AConstantStaysTheConstant)
{
  auto filter = MakeSkinOver(MakeSource([](double) { return MakeCloud(MakeBlob(0.0)); }));
  filter->PassTargetArraysOn();
  filter->Update();
  vtkPointData* arrays = filter->GetOutput()->GetPointData();
  double range[2] = { 0.0, 0.0 };
  EXPECT_GT(double(filter->GetOutput()->GetNumberOfPoints()), 100.0) << "points of the skin";
  arrays->GetArray("constant")->GetRange(range);
  EXPECT_NEAR(range[0], 7.25, 1e-6) << "smallest";
  EXPECT_NEAR(range[1], 7.25, 1e-6) << "largest";
  EXPECT_TRUE(arrays->GetScalars() == arrays->GetArray("temperature")) << "the active scalars too";
}

double CubicSpline(double q)
{
  return q <= .5 ? 1.0 - 6.0 * q * q * (1.0 - q) : 2.0 * std::pow(1.0 - q, 3.0);
}

double Metaball(double q)
{
  return q <= 1.0 / 3.0 ? 1.0 - 3.0 * q * q : 1.5 * (1.0 - q) * (1.0 - q);
}

void CheckAverages(int number, KernelFormula kernel)
{
  const std::vector<Grain> grains = MakeBlob(0.0);
  auto filter = MakeSkinOver(MakeSource([grains](double) { return MakeCloud(grains); }));
  filter->SetParticleKernel(number);
  filter->PassTargetArraysOn();
  filter->Update();
  vtkPolyData* skin = filter->GetOutput();
  vtkDataArray* temperatures = skin->GetPointData()->GetArray("temperature");
  vtkDataArray* ids = skin->GetPointData()->GetArray("id");
  double worst = 0.0;
  vtkIdType otherIds = 0;
  for (vtkIdType v = 0; v < skin->GetNumberOfPoints(); ++v)
  {
    const Expected expected = FindExpected(grains, skin->GetPoint(v), kernel);
    worst = std::max(worst, std::fabs(temperatures->GetComponent(v, 0) - expected.Temperature));
    otherIds += ids->GetComponent(v, 0) != expected.Id ? 1 : 0;
  }
  EXPECT_GT(skin->GetNumberOfPoints(), vtkIdType(100)) << "points, kernel " << number;
  EXPECT_LT(worst, 1e-12) << "largest difference of the averages, kernel " << number;
  EXPECT_EQ(otherIds, vtkIdType(0)) << "points with another id, kernel " << number;
}

TEST(TestPassedArrays, AnAverageIsTheFormula)
{
  CheckAverages(vtkSkeletonPotential::WYVILL, Wyvill);
  CheckAverages(vtkSkeletonPotential::CUBIC_SPLINE, CubicSpline);
  CheckAverages(vtkSkeletonPotential::METABALL, Metaball);
}

TEST(TestPassedArrays, TwoBallsKeepTheirOwn)
{
  const std::vector<Grain> grains = { { -0.5, 0.0, 0.0, 1, 1.5 }, { 0.5, 0.0, 0.0, 2, 2.5 } };
  auto filter = MakeSkinOver(MakeSource([grains](double) { return MakeCloud(grains); }));
  filter->PassTargetArraysOn();
  filter->Update();
  vtkPolyData* skin = filter->GetOutput();
  auto names = vtkStringArray::SafeDownCast(skin->GetPointData()->GetAbstractArray("name"));
  EXPECT_TRUE(names != nullptr) << "names are passed";
  vtkIdType wrong = 0;
  for (vtkIdType v = 0; v < skin->GetNumberOfPoints(); ++v)
  {
    const bool isLeft = skin->GetPoint(v)[0] < 0.0;
    wrong += names->GetValue(v) != (isLeft ? "grain 1" : "grain 2") ||
        skin->GetPointData()->GetArray("temperature")->GetComponent(v, 0) != (isLeft ? 1.5 : 2.5)
      ? 1
      : 0;
  }
  EXPECT_EQ(wrong, vtkIdType(0)) << "points that have what is not theirs";
}

TEST(TestPassedArrays, WhereNoKernelReachesTheNearestCounts)
{
  const std::vector<Grain> grains = { { -0.5, 0.0, 0.0, 1, 1.5 }, { 0.5, 0.0, 0.0, 2, 2.5 } };
  auto filter = MakeSkinOver(MakeSource([grains](double) { return MakeCloud(grains); }));
  filter->SetInitialFunction(MakeBallFunction(0.95));
  filter->PassTargetArraysOn();
  filter->Update();
  vtkPolyData* skin = filter->GetOutput();
  vtkIdType beyond = 0, wrong = 0;
  for (vtkIdType v = 0; v < skin->GetNumberOfPoints(); ++v)
  {
    const double* x = skin->GetPoint(v);
    if (std::fabs(x[0]) < 0.1)
    {
      ++beyond;
      const double value = skin->GetPointData()->GetArray("temperature")->GetComponent(v, 0);
      wrong += value != (x[0] < 0.0 ? 1.5 : 2.5) ? 1 : 0;
    }
  }
  EXPECT_GT(double(beyond), 100.0) << "points beyond all kernels";
  EXPECT_EQ(wrong, vtkIdType(0)) << "of which are wrong";
}

// Particle 2, of value 300, is born at the position of particle 1, of value 100, between step 0 and
// step 1. At a fraction f of this interval the kernel of particle 2 is multiplied by f, so its
// value has the weight f / (1 + f).
TEST(TestPassedArrays, ABirthComesInByItsStrength)
{
  const auto cloud = [](double time)
  {
    std::vector<Grain> grains = { { 0.0, 0.0, 0.0, 1, 100.0 } };
    if (time > 0.5)
    {
      grains.push_back({ 0.0, 0.0, 0.0, 2, 300.0 });
    }
    return MakeCloud(grains);
  };
  auto filter = MakeSkinOver(MakeSource(cloud, { 0.0, 1.0 }));
  filter->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "id");
  filter->PassTargetArraysOn();
  for (const double fraction : { 0.0, 0.01, 0.25, 0.75, 1.0 })
  {
    filter->UpdateTimeStep(fraction);
    double range[2];
    filter->GetOutput()->GetPointData()->GetArray("temperature")->GetRange(range);
    const double expected = 100.0 + 200.0 * fraction / (1.0 + fraction);
    EXPECT_NEAR(range[0], expected, 1e-10) << "least at " << fraction;
    EXPECT_NEAR(range[1], expected, 1e-10) << "largest at " << fraction;
  }
}

TEST(TestPassedArrays, BetweenStepsValuesGoEvenly)
{
  const auto cloud = [](double time) {
    return MakeCloud({ { 0.1 * time, 0.0, 0.0, 1, 10.0 * time * time } });
  };
  auto filter = MakeSkinOver(MakeSource(cloud, { 0.0, 1.0, 2.0 }));
  filter->PassTargetArraysOn();
  filter->UpdateTimeStep(1.25);
  double range[2];
  filter->GetOutput()->GetPointData()->GetArray("temperature")->GetRange(range);
  EXPECT_NEAR(range[0], 10.0 + 0.25 * 30.0, 1e-12) << "least";
  EXPECT_NEAR(range[1], 10.0 + 0.25 * 30.0, 1e-12) << "largest";
}

// Grains that are born and die, in a moving cloud: 4 frames.
vtkSmartPointer<ShapeSource> MakeFlow()
{
  return MakeSource(
    [](double time)
    {
      std::vector<Grain> grains = MakeBlob(0.1 * time);
      grains.erase(grains.begin() + static_cast<int>(time));
      grains.back().Id += 100 * static_cast<int>(time);
      return MakeCloud(grains);
    },
    { 0.0, 1.0, 2.0, 3.0 });
}

vtkSmartPointer<vtkActiveImplicitSurface> MakeCoat()
{
  auto filter = MakeSkinOver(MakeFlow());
  filter->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "id");
  return filter;
}

void WishForAll(vtkActiveImplicitSurface* filter)
{
  filter->PassTargetArraysOn();
  filter->ComputeVelocityOn();
  filter->TangentialVelocityOn();
}

// Arrays are switched on late, at a time restored from a checkpoint, while other frames are in
// memory.
TEST(TestPassedArrays, ArraysDoNotDependOnTheWay)
{
  for (const double time : { 0.0, 0.5, 1.0, 2.75, 3.0 })
  {
    auto direct = MakeCoat();
    WishForAll(direct);
    direct->UpdateTimeStep(time);
    const std::string expected = GetArrayBytes(direct);
    EXPECT_TRUE(direct->GetOutput()->GetPointData()->HasArray("temperature")) << "it is there";

    auto filter = MakeCoat();
    filter->SetCheckpointInterval(1);
    filter->UpdateTimeStep(3.0);
    filter->UpdateTimeStep(1.5);
    filter->UpdateTimeStep(time);
    filter->ResetCounters();
    WishForAll(filter);
    filter->UpdateTimeStep(time);
    EXPECT_TRUE(AreSameSkins(GetArrayBytes(filter), expected)) << "the same at " << time;
    EXPECT_EQ(filter->GetSubsteps(), vtkIdType(0)) << "substeps for that";
    filter->SetNumberOfThreads(1);
    filter->UpdateTimeStep(time);
    EXPECT_TRUE(AreSameSkins(GetArrayBytes(filter), expected)) << "with one thread";
  }
}

TEST(TestPassedArrays, ArraysThatCannotBeCarriedAreLeftOut)
{
  const auto cloud = [](double time)
  {
    auto points = MakeCloud(MakeBlob(0.0));
    AddFloats(points, "Normals", 3, 9.0);
    AddFloats(points, "vtkGhostType", 1, 1.0);
    AddFloats(points, time > 0.5 ? "late" : "early", 1, 1.0);
    AddFloats(points, "unlike", time > 0.5 ? 2 : 1, 1.0);
    return points;
  };
  auto filter = MakeSkinOver(MakeSource(cloud, { 0.0, 1.0 }));
  filter->PassTargetArraysOn();
  filter->UpdateTimeStep(0.5);
  vtkPointData* arrays = filter->GetOutput()->GetPointData();
  EXPECT_NEAR(std::fabs(arrays->GetArray("Normals")->GetComponent(0, 0)), 0.5, 0.5)
    << "own normals";
  for (const char* name : { "vtkGhostType", "early", "late", "unlike" })
  {
    EXPECT_TRUE(!arrays->HasArray(name)) << "no " << name;
  }
  filter->UpdateTimeStep(1.0);
  arrays = filter->GetOutput()->GetPointData();
  EXPECT_TRUE(arrays->HasArray("late") && arrays->HasArray("unlike"))
    << "at a step there is no doubt";
}

TEST(TestPassedArrays, OtherTargetsHaveNone)
{
  auto filter = MakeShrinkingBall();
  MessageCapture messages(filter);
  WishForAll(filter);
  filter->UpdateTimeStep(0.1);
  filter->UpdateTimeStep(0.2);
  EXPECT_EQ(MessageCapture::Count(messages.Warnings, "no particles"), 1) << "warnings";
  EXPECT_EQ(filter->GetOutput()->GetPointData()->GetNumberOfArrays(), 2) << "Normals and Velocity";
}

}
