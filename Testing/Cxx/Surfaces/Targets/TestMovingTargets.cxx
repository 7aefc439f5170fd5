// Skeletons, meshes and images as the target: their motion between steps.

#include "Support/MessageCapture.h"
#include "Support/PipelineTools.h"
#include "Support/ShapeSource.h"

#include "vtkCellArray.h"
#include "vtkImageData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSphere.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

using namespace activesurface;

namespace TestMovingTargets
{

namespace
{

constexpr double VoxelSize = 0.05;

// Derivation: see TestTargets.cxx.
constexpr double MeshError = 0.06 * VoxelSize;
constexpr double ImageError = 0.06 * VoxelSize;

// The target's centre moves along x by 0.2 per unit of time, and the skin starts without a lag.
void FollowsTheBall(ShapeSource* source, double tolerance)
{
  auto filter = MakeSkinOver(source);
  for (const double time : { 0.0, 0.75, 1.0, 1.5, 2.0 })
  {
    filter->UpdateTimeStep(time);
    const auto bounds = GetSkinBounds(filter);
    const double lag = 0.2 / 10.0 * (1.0 - std::exp(-10.0 * time));
    EXPECT_NEAR(0.5 * (bounds[0] + bounds[1]), 0.2 * time - lag, tolerance) << "centre at " << time;
  }
  EXPECT_EQ(source->GetExecutions(), "0 1 2 ") << "times asked for";
}

}

// The lag is 0.2 / Attraction, within 0.12 h as for particles. On the x axis, a blend of the
// distances to two balls is the distance to the ball on the straight path.
TEST(TestMovingTargets, SkinFollowsAMovingMesh)
{
  const auto source = MakeSource([](double t) { return MakeBallMesh(0.5, 0.2 * t); }, { 0, 1, 2 });
  FollowsTheBall(source, 0.12 * VoxelSize + MeshError);
}

// Blends of squared distances are exact.
TEST(TestMovingTargets, SkinFollowsAMovingImage)
{
  const auto source = MakeSource([](double t) { return MakeBallImage(0.5, 0.2 * t); }, { 0, 1, 2 });
  FollowsTheBall(source, 0.12 * VoxelSize + ImageError);
}

// Halfway between two functions is their mean: for r^2 - 0.36 and r^2 - 0.16, r^2 - 0.26.
TEST(TestMovingTargets, StepsAreBlendedEvenly)
{
  const auto shape = [](double t) { return MakeBallImage(t == 0.0 ? 0.6 : 0.4); };
  auto filter = MakeSkinOver(MakeSource(shape, { 0, 1 }));
  filter->SetAttraction(100.0);
  filter->UpdateTimeStep(0.5);
  // The radius decreases by 0.2 per unit of time: a lag of 0.002, 0.04 h.
  CheckBall(filter, std::sqrt(0.26), ImageError + 0.06 * VoxelSize, "half way");
}

TEST(TestMovingTargets, NumberOfParticlesMayChange)
{
  vtkNew<ParticleSource> source;
  source->SetCloud(
    [](double t)
    {
      const int count = t == 0.0 ? 3 : t == 1.0 ? 5 : 1;
      std::vector<Particle> particles;
      for (int i = 0; i < count; ++i)
      {
        particles.push_back({ 0.15 * i, 0.0, 0.0, i });
      }
      return particles;
    });
  source->SetSteps({ 0.0, 1.0, 2.0 });
  auto filter = MakeSkin();
  filter->SetInputConnection(source->GetOutputPort());
  MessageCapture messages(filter);
  filter->UpdateTimeStep(1.5);
  EXPECT_GT(filter->GetOutput()->GetNumberOfPolys(), 0) << "triangles";
  filter->UpdateTimeStep(2.0);
  EXPECT_GT(filter->GetOutput()->GetNumberOfPolys(), 0) << "triangles";
  EXPECT_EQ(messages.CountAll(), 0u) << "messages";
}

TEST(TestMovingTargets, KindThatChangesIsAnError)
{
  const auto shape = [](double t)
  {
    vtkNew<vtkPolyData> points;
    points->SetPoints(MakeLines()->GetPoints());
    return t < 2.0 ? vtkSmartPointer<vtkPolyData>(points) : MakeBallMesh(0.5);
  };
  auto filter = MakeSkinOver(MakeSource(shape, { 0, 1, 2 }));
  const std::string before = GetBytesAt(filter, 1.0);
  MessageCapture messages(filter);
  filter->UpdateTimeStep(2.0);
  EXPECT_EQ(MessageCapture::Count(
              messages.Errors, "The target is a mesh at the time step 2, but particles before"),
    1)
    << "errors";
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0) << "points";
  EXPECT_TRUE(AreSameSkins(GetBytesAt(filter, 1.0), before))
    << "the same bytes before it, afterwards";
}

// From halfway to the empty step on, no point is inside the target. The skin shrinks at Attraction
// * TargetReach, 0.2 per unit of time, until halfway back. CFL is set because a skin in a steady
// state would make one substep.
TEST(TestMovingTargets, EmptyStepIsNoTarget)
{
  const auto leaving = [](double t)
  { return t == 2.0 ? vtkSmartPointer<vtkPolyData>::New() : MakeBallMesh(0.5); };
  const auto steps = std::vector<double>{ 0, 1, 2, 3 };
  auto filter = MakeSkinOver(MakeSource(leaving, steps));
  filter->SetTargetReach(0.2);
  filter->SetAttraction(1.0);
  filter->SetCFL(0.1);
  MessageCapture messages(filter);
  filter->UpdateTimeStep(1.0);
  CheckBall(filter, 0.5, MeshError, "before");
  filter->UpdateTimeStep(2.0);
  EXPECT_LT(GetRadii(filter).Largest, 0.4) << "radius when it is gone";
  const std::string gone = GetBytes(filter);
  filter->UpdateTimeStep(2.5);
  const double least = GetRadii(filter).Largest;
  EXPECT_LT(least, 0.3) << "radius half way back";
  filter->UpdateTimeStep(3.0);
  EXPECT_LT(least, GetRadii(filter).Least) << "radius when it is back";
  EXPECT_EQ(messages.CountAll(), 1u) << "messages";
  EXPECT_TRUE(messages.Has("is outside the skin")) << "as it lags";

  const auto losing = [](double t)
  {
    vtkSmartPointer<vtkPolyData> mesh = MakeBallMesh(0.5);
    mesh->SetPolys(t == 2.0 ? nullptr : mesh->GetPolys());
    return mesh;
  };
  auto other = MakeSkinOver(MakeSource(losing, steps));
  other->SetTargetReach(0.2);
  other->SetAttraction(1.0);
  other->SetCFL(0.1);
  EXPECT_TRUE(AreSameSkins(GetBytesAt(other, 2.0), gone)) << "a mesh without polygons is none";
}

TEST(TestMovingTargets, MeshThatAppearsLaterAttractsTheInitialShape)
{
  const auto coming = [](double t)
  { return t == 0.0 ? vtkSmartPointer<vtkPolyData>::New() : MakeBallMesh(0.5); };
  auto filter = MakeSkinOver(MakeSource(coming, { 0, 1, 2 }));
  vtkNew<vtkSphere> start;
  start->SetRadius(0.6);
  filter->SetInitialFunction(start);
  filter->SetTargetReach(0.01);
  filter->UpdateTimeStep(2.0);
  CheckBall(filter, 0.5, MeshError, "at the end");
}

}
