// Bound of the vectors of "Velocity": MaximumVelocity, and its automatic value.

#include "Support/GrainTools.h"
#include "Support/MessageCapture.h"
#include "Support/PipelineTools.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

using namespace activesurface;

namespace TestVelocityBound
{

constexpr double Voxel = 0.03;
constexpr double Unbounded = 1e30;

using Cloud = std::function<std::vector<Grain>(double time)>;

vtkSmartPointer<vtkActiveImplicitSurface> MakeMovingSkin(const Cloud& cloud, double maximum)
{
  auto filter = MakeSkinOver(MakeSource(
    [cloud](double time) { return MakeCloud(cloud(time)); }, { 0.0, 1.0, 2.0, 3.0, 4.0 }));
  filter->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "id");
  filter->SetVoxelSize(Voxel);
  filter->ComputeVelocityOn();
  filter->SetMaximumVelocity(maximum);
  return filter;
}

// Two grains: the first one stands still, and the second one approaches with speed 0.1.
std::vector<Grain> Meeting(double time)
{
  return { { -0.2, 0.0, 0.0, 1, 0.0 }, { 0.25 - 0.1 * time, 0.0, 0.0, 2, 0.0 } };
}
constexpr double MeetingSpeed = 0.1;

std::vector<Grain> Translation(double time)
{
  return { { 0.2 * time - 0.4, 0.0, 0.0, 1, 0.0 } };
}

double GetLength(const double v[3])
{
  return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

vtkDataArray* GetVelocity(vtkActiveImplicitSurface* filter)
{
  return filter->GetOutput()->GetPointData()->GetArray("Velocity");
}

double FindLargest(vtkActiveImplicitSurface* filter, double time)
{
  filter->UpdateTimeStep(time);
  double largest = 0.0;
  for (vtkIdType v = 0; v < GetVelocity(filter)->GetNumberOfTuples(); ++v)
  {
    largest = std::max(largest, GetLength(GetVelocity(filter)->GetTuple3(v)));
  }
  return largest;
}

// Vectors have single precision.
constexpr double Rounding = 1e-6;

TEST(TestVelocityBound, PartsThatMergeGoNoFasterThanTheirParticles)
{
  auto bounded = MakeMovingSkin(Meeting, 0.0);
  auto unbounded = MakeMovingSkin(Meeting, Unbounded);
  double largest = 0.0;
  for (double time = 0.25; time <= 4.0; time += 0.25)
  {
    EXPECT_LT(FindLargest(bounded, time), MeetingSpeed * (1.0 + Rounding))
      << "largest velocity at " << time;
    largest = std::max(largest, FindLargest(unbounded, time));
  }
  EXPECT_LT(2.0 * MeetingSpeed, largest) << "largest velocity without a bound";
}

TEST(TestVelocityBound, OnlyLongVectorsAreShortened)
{
  auto bounded = MakeMovingSkin(Meeting, 0.5 * MeetingSpeed);
  auto unbounded = MakeMovingSkin(Meeting, Unbounded);
  bounded->TangentialVelocityOff(); // only the normal part is shortened
  unbounded->TangentialVelocityOff();
  EXPECT_LT(FindLargest(bounded, 2.5), 0.5 * MeetingSpeed * (1.0 + Rounding)) << "largest velocity";
  unbounded->UpdateTimeStep(2.5);
  int shortened = 0, kept = 0;
  for (vtkIdType v = 0; v < GetVelocity(bounded)->GetNumberOfTuples(); ++v)
  {
    double now[3], before[3];
    GetVelocity(bounded)->GetTuple(v, now);
    GetVelocity(unbounded)->GetTuple(v, before);
    const bool isLong = GetLength(before) > 0.5 * MeetingSpeed;
    const double scale = isLong ? 0.5 * MeetingSpeed / GetLength(before) : 1.0;
    double off = 0.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      off = std::max(off, std::fabs(now[axis] - scale * before[axis]));
    }
    EXPECT_LT(off, isLong ? Rounding : 1e-300) << "difference from the vector, shortened";
    ++(isLong ? shortened : kept);
  }
  EXPECT_LT(10, shortened) << "vectors that are too long";
  EXPECT_LT(10, kept) << "others";
}

// The lag of a skin behind a moving ball is accurate to 0.12 voxel (TestTracking), so the speed of
// the skin is accurate to Attraction times this length.
TEST(TestVelocityBound, ATranslationIsNotShortened)
{
  constexpr double attraction = 10.0;
  for (const bool tangential : { false, true })
  {
    auto bounded = MakeMovingSkin(Translation, 0.0);
    auto unbounded = MakeMovingSkin(Translation, Unbounded);
    bounded->SetTangentialVelocity(tangential);
    unbounded->SetTangentialVelocity(tangential);
    bounded->UpdateTimeStep(2.5);
    unbounded->UpdateTimeStep(2.5);
    double off = 0.0;
    for (vtkIdType v = 0; v < GetVelocity(bounded)->GetNumberOfTuples(); ++v)
    {
      double difference[3];
      for (int axis = 0; axis < 3; ++axis)
      {
        difference[axis] = GetVelocity(bounded)->GetComponent(v, axis) -
          GetVelocity(unbounded)->GetComponent(v, axis);
      }
      off = std::max(off, GetLength(difference));
    }
    EXPECT_LT(off, 0.12 * Voxel * attraction) << "largest difference";
    EXPECT_LT(0.19, FindLargest(bounded, 2.5)) << "largest velocity, .2";
  }
}

TEST(TestVelocityBound, TheBoundIsPerMotionTime)
{
  auto filter = MakeMovingSkin(Meeting, 0.0);
  filter->SetTimeScale(0.1);
  double largest = 0.0;
  for (double time = 1.0; time <= 4.0; time += 0.5)
  {
    largest = std::max(largest, FindLargest(filter, time));
  }
  EXPECT_NEAR(largest / MeetingSpeed, 10.0, 10.0 * Rounding)
    << "largest velocity, ten times as fast";
}

// Static particles and functions as targets have no automatic bound.
TEST(TestVelocityBound, WhatGrowsOrStandsStillIsNotBoundToStand)
{
  const Cloud still = [](double) { return Meeting(2.5); };
  auto standing = MakeMovingSkin(still, 0.0);
  standing->SetInitialFunction(MakeBallFunction(0.9));
  EXPECT_LT(MeetingSpeed, FindLargest(standing, 0.25)) << "a skin that moves to static particles";
  auto direct = MakeMovingSkin(still, Unbounded);
  direct->SetInitialFunction(MakeBallFunction(0.9));
  direct->UpdateTimeStep(0.25);
  EXPECT_TRUE(GetArrayBytes(standing) == GetArrayBytes(direct))
    << "its bytes are those without a bound";
  auto ball = MakeShrinkingBall();
  ball->ComputeVelocityOn();
  const double largest = FindLargest(ball, 0.2);
  EXPECT_LT(0.05, largest) << "a skin that moves to a function";
  ball->ResetCounters();
  ball->SetMaximumVelocity(0.5 * largest);
  EXPECT_NEAR(FindLargest(ball, 0.2), 0.5 * largest, Rounding) << "with a bound";
  EXPECT_EQ(ball->GetSubsteps(), vtkIdType(0)) << "substeps for it";
}

TEST(TestVelocityBound, TheBoundDoesNotDependOnTheOrderOfRequests)
{
  auto straight = MakeMovingSkin(Meeting, 0.0);
  auto back = MakeMovingSkin(Meeting, 0.0);
  back->SetCheckpointInterval(1);
  back->UpdateTimeStep(4.0);
  for (const double time : { 3.0, 2.5, 2.0, 1.0, 0.0, 2.0 })
  {
    straight = MakeMovingSkin(Meeting, 0.0);
    straight->UpdateTimeStep(time);
    back->UpdateTimeStep(time);
    EXPECT_TRUE(GetArrayBytes(straight) == GetArrayBytes(back)) << "bytes at " << time;
  }
}

TEST(TestVelocityBound, ABoundThatIsNoNumberIsRefused)
{
  auto filter = MakeMovingSkin(Meeting, std::nan(""));
  MessageCapture messages(filter);
  filter->UpdateTimeStep(1.0);
  EXPECT_EQ(MessageCapture::Count(messages.Errors, "MaximumVelocity has to be"), 1) << "errors";
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), vtkIdType(0)) << "points";
}

}
