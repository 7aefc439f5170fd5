// The column Outside of the history: the part of the target outside the skin, and its warning.

#include "Support/HistoryTools.h"
#include "Support/MessageCapture.h"
#include "Support/OutputFiles.h"
#include "Support/PipelineTools.h"
#include "Support/ShapeSource.h"

#include "vtkDataObject.h"
#include "vtkDoubleArray.h"
#include "vtkIdList.h"
#include "vtkImageData.h"
#include "vtkImplicitBoolean.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSphere.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

using namespace activesurface;

namespace TestOutside
{

namespace
{

constexpr double Spacing = 0.2;
constexpr double R = 0.5 * Spacing;
constexpr double BallRadius = 0.5;

// A block of 4 x 4 x 4 particles, and from time 1 on another particle, far away.
std::vector<Particle> MakeBlockAndDrop(double time)
{
  std::vector<Particle> particles;
  for (int i = 0; i < 64; ++i)
  {
    particles.push_back({ Spacing * (i % 4), Spacing * (i / 4 % 4), Spacing * (i / 16), i });
  }
  if (time >= 1.0)
  {
    particles.push_back({ 2.0, 0.0, 0.0, 64 });
  }
  return particles;
}

vtkSmartPointer<vtkActiveImplicitSurface> MakeSkinOverDrop(bool createsParts)
{
  vtkNew<ParticleSource> source;
  source->SetCloud(MakeBlockAndDrop);
  source->SetSteps({ 0.0, 1.0, 2.0, 3.0 });
  auto filter = vtkSmartPointer<vtkActiveImplicitSurface>::New();
  filter->SetInputConnection(source->GetOutputPort());
  filter->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "id");
  filter->SetTimeIntegrationToExplicit();
  filter->SetParticleSpacing(Spacing);
  filter->SetCreateParts(createsParts);
  return filter;
}

// Particles at, or lines through, the points (x, 0, 0).
vtkSmartPointer<vtkPolyData> MakePoints(const std::vector<double>& places, bool areLinked)
{
  vtkNew<vtkPoints> points;
  vtkNew<vtkIdList> all;
  for (const double x : places)
  {
    all->InsertNextId(points->InsertNextPoint(x, 0.0, 0.0));
  }
  auto data = vtkSmartPointer<vtkPolyData>::New();
  data->SetPoints(points);
  if (areLinked)
  {
    data->AllocateExact(1, all->GetNumberOfIds());
    data->InsertNextCell(VTK_POLY_LINE, all);
  }
  return data;
}

// A ball around the origin that stands still, whatever its target.
vtkSmartPointer<vtkActiveImplicitSurface> MakeStandingBall(double voxelSize)
{
  auto filter = vtkSmartPointer<vtkActiveImplicitSurface>::New();
  filter->SetModelBounds(-1.0, 1.0, -1.0, 1.0, -1.0, 1.0);
  filter->SetVoxelSize(voxelSize);
  vtkNew<vtkSphere> ball;
  ball->SetRadius(BallRadius);
  filter->SetInitialFunction(ball);
  filter->SetAttraction(0.0);
  filter->SetTimeIntegrationToExplicit();
  filter->SetParticleSpacing(Spacing);
  return filter;
}

double GetOutsideAt(vtkActiveImplicitSurface* filter, double time)
{
  filter->UpdateTimeStep(time);
  return GetNumber(filter, CountRows(filter) - 1, "Outside");
}

}

// One of 65 particles is 0.015 of them.
TEST(TestOutside, ALostDropIsToldOnce)
{
  auto filter = MakeSkinOverDrop(false);
  MessageCapture messages(filter);
  filter->UpdateTimeStep(3.0);
  EXPECT_EQ(GetNumber(filter, 0, "Outside"), 0.0);
  for (int row = 1; row < 4; ++row)
  {
    EXPECT_EQ(GetNumber(filter, row, "Outside"), 1.0 / 65.0) << "row " << row;
  }
  EXPECT_EQ(MessageCapture::Count(messages.Warnings,
              "At the time 1, 1.5 % of the particles are outside the skin by more than their "
              "own radius"),
    1);
  EXPECT_TRUE(messages.Has("turn CreateParts on"));
  EXPECT_EQ(messages.CountAll(), 1u);
  filter->UpdateTimeStep(0.0);
  filter->UpdateTimeStep(3.0);
  EXPECT_EQ(messages.CountAll(), 1u) << "an earlier time does not repeat the warning";
  filter->SetTension(1e-5);
  filter->UpdateTimeStep(3.0);
  EXPECT_EQ(messages.CountAll(), 2u) << "a new run repeats the warning";
}

TEST(TestOutside, ADropWithAPartIsInside)
{
  auto filter = MakeSkinOverDrop(true);
  MessageCapture messages(filter);
  for (const double time : { 0.0, 1.0, 2.0, 3.0 })
  {
    EXPECT_EQ(GetOutsideAt(filter, time), 0.0) << "at " << time;
  }
  EXPECT_EQ(messages.CountAll(), 0u);
}

// The skin's ball is accurate to a hundredth of r: its chords are within h^2 / (8 * 0.5).
TEST(TestOutside, AParticleMayBeOutsideByItsOwnRadius)
{
  const std::vector<double> places = { 0.0, 0.4, BallRadius + 0.5 * R, BallRadius + 0.95 * R,
    BallRadius + 1.05 * R, BallRadius + 3.0 * R, BallRadius + 4.5 * R, -BallRadius - 1.05 * R };
  for (const double voxelsPerRadius : { 1.5, 5.0 }) // the band ends at 3
  {
    for (const int model : { 0, 1, 2 })
    {
      for (const bool areLinked : { false, true })
      {
        auto filter = MakeStandingBall(R / voxelsPerRadius);
        filter->SetParticleModel(model);
        const auto points = MakePoints(places, areLinked);
        filter->SetInputData(points);
        EXPECT_EQ(GetOutsideAt(filter, 0.1), 4.0 / 8.0)
          << voxelsPerRadius << " voxels, model " << model << (areLinked ? ", lines" : "");
      }
    }
  }
}

// The own radius follows from KernelRadius or from the array of radii.
TEST(TestOutside, AKernelTellsTheRadiusToo)
{
  const auto points = MakePoints({ 0.0, BallRadius + 0.95 * R, BallRadius + 1.05 * R }, false);
  auto filter = MakeStandingBall(0.05);
  filter->SetInputData(points);
  filter->SetParticleModelToSum();
  filter->SetParticleSpacing(-1.0);
  filter->SetKernelRadius(2.0 * Spacing);
  EXPECT_EQ(GetOutsideAt(filter, 0.1), 1.0 / 3.0);

  vtkNew<vtkDoubleArray> radii;
  radii->SetName("size");
  for (const double spacing : { Spacing, 0.5 * Spacing, 2.0 * Spacing })
  {
    radii->InsertNextValue(0.5 * spacing);
  }
  points->GetPointData()->AddArray(radii);
  auto second = MakeStandingBall(0.05);
  second->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "size");
  second->SetInputData(points);
  EXPECT_EQ(GetOutsideAt(second, 0.1), 1.0 / 3.0) << "now it is the other one";
}

// The part of a ball of radius 0.8 that is farther than a voxel of 0.05 outside the skin of radius
// 0.5 is 1 - (0.55 / 0.8)^3 = 0.675. The tolerance is three times the error of random points,
// sqrt(0.675 * 0.325 / 4096); the points of a low-discrepancy sequence are more accurate.
TEST(TestOutside, AShapeCountsByItsVolume)
{
  constexpr double radius = 0.8, share = 0.675, tolerance = 0.022;
  auto overMesh = MakeStandingBall(0.05);
  overMesh->SetInputData(MakeBallMesh(radius));
  EXPECT_NEAR(GetOutsideAt(overMesh, 0.1), share, tolerance) << "a mesh";
  auto overImage = MakeStandingBall(0.05);
  overImage->SetInputData(MakeBallImage(radius));
  EXPECT_NEAR(GetOutsideAt(overImage, 0.1), share, tolerance) << "an image";
  auto overFunction = MakeStandingBall(0.05);
  overFunction->SetTargetFunction(MakeBallFunction(radius));
  EXPECT_NEAR(GetOutsideAt(overFunction, 0.1), share, tolerance) << "a function";

  // A mesh grows with its level: 0.7 + 0.1.
  auto level = MakeStandingBall(0.05);
  level->SetInputData(MakeBallMesh(0.7));
  level->SetTargetIsoValue(0.1);
  EXPECT_NEAR(GetOutsideAt(level, 0.1), share, tolerance) << "a level of a mesh";

  auto inverse = MakeStandingBall(0.05);
  inverse->SetInputData(MakeBallMesh(radius));
  inverse->SetInvertTarget(true);
  EXPECT_EQ(GetOutsideAt(inverse, 0.1), 1.0) << "the ball of the skin is nowhere in it";
}

// With BoundedDomain the skin cannot reach the particle at 1.4.
TEST(TestOutside, WhatIsBeyondAWallDoesNotCount)
{
  for (const bool isBounded : { false, true })
  {
    auto filter = MakeStandingBall(0.05);
    filter->SetBoundedDomain(isBounded);
    filter->SetInputData(MakePoints({ 0.0, 0.3, 1.4 }, false));
    EXPECT_EQ(GetOutsideAt(filter, 0.1), isBounded ? 0.0 : 1.0 / 3.0);
  }
}

TEST(TestOutside, AMovingMeshThatIsLostIsTold)
{
  auto filter = vtkSmartPointer<vtkActiveImplicitSurface>::New();
  filter->SetInputConnection(
    MakeSource([](double time) { return MakeBallMesh(0.4, 0.3 * time); }, { 0.0, 1.0, 2.0 })
      ->GetOutputPort());
  filter->SetVoxelSize(0.05);
  filter->SetAttraction(1e-3);
  MessageCapture messages(filter);
  const double second = GetOutsideAt(filter, 1.0);
  EXPECT_GT(second, 0.1);
  EXPECT_GT(GetOutsideAt(filter, 2.0), second);
  EXPECT_EQ(MessageCapture::Count(messages.Warnings, "% of the target is outside the skin;"), 1);
  EXPECT_FALSE(messages.Has("Transport"));
}

// Otherwise each metamorphosis would cause a warning at its start.
TEST(TestOutside, ASkinOnItsWayIsNotLost)
{
  auto filter = MakeStandingBall(0.05);
  filter->SetTargetFunction(MakeBallFunction(0.8));
  filter->SetAttraction(1.0);
  MessageCapture messages(filter);
  EXPECT_GT(GetOutsideAt(filter, 0.0), 0.6);
  EXPECT_LT(GetOutsideAt(filter, 1.0), 0.3);
  EXPECT_EQ(messages.CountAll(), 0u);

  vtkNew<vtkImplicitBoolean> both;
  both->AddFunction(MakeBallFunction(0.4));
  both->AddFunction(MakeBallFunction(0.15, 0.8));
  filter->SetTargetFunction(both);
  filter->SetCreateParts(false);
  filter->SetTimeStepSize(1.0);
  filter->UpdateTimeStep(8.0);
  EXPECT_EQ(messages.CountAll(), 1u) << "a part that it never reaches";
  EXPECT_TRUE(messages.Has("target is outside the skin"));
  EXPECT_FALSE(messages.Has("VolumeControl"));
}

TEST(TestOutside, AVolumeThatIsHeldIsNamed)
{
  auto filter = MakeStandingBall(0.05);
  filter->SetTargetFunction(MakeBallFunction(0.8));
  filter->SetAttraction(1.0);
  filter->SetVolumeControlToExact();
  filter->SetTimeStepSize(1.0);
  MessageCapture messages(filter);
  filter->UpdateTimeStep(8.0);
  EXPECT_TRUE(messages.Has("VolumeControl or AreaControl may keep the skin too small"));
}

TEST(TestOutside, EmptySkinsAreOutsideOfAll)
{
  auto filter = MakeShrinkingBall();
  filter->SetTargetFunction(MakeBallFunction(0.2, 3.0));
  filter->SetModelBounds(-1.0, 4.0, -1.0, 1.0, -1.0, 1.0);
  MessageCapture messages(filter);
  EXPECT_EQ(GetOutsideAt(filter, 1.0), 1.0);
  EXPECT_EQ(MessageCapture::Count(messages.Warnings, "has vanished"), 1);
}

TEST(TestOutside, AStateGoesOnWithTheSameShares)
{
  const std::string file = OutputName("state_with_shares.vdb");
  auto first = MakeSkinOverDrop(false);
  first->UpdateTimeStep(2.0);
  EXPECT_TRUE(first->SaveState(file.c_str()));
  auto second = MakeSkinOverDrop(false);
  second->LoadState(file.c_str());
  second->UpdateTimeStep(3.0);
  first->SetNumberOfThreads(1);
  first->UpdateTimeStep(3.0);
  EXPECT_EQ(GetHistoryText(second), GetHistoryText(first));
}

}
