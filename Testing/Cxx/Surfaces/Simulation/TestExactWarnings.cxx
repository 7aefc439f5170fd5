// Warnings of an exact control of volume or area about a target that the skin cannot reach. Other
// targets cause no warning.

#include "Support/MessageCapture.h"
#include "Support/PipelineTools.h"

#include "vtkNew.h"
#include "vtkSphere.h"

#include <gtest/gtest.h>

using namespace activesurface;

namespace TestExactWarnings
{

namespace
{

constexpr const char* Words = "Check that target and initial shape overlap.";

vtkSmartPointer<vtkSphere> MakeSphere(double x, double radius)
{
  auto sphere = vtkSmartPointer<vtkSphere>::New();
  sphere->SetCenter(x, 0.0, 0.0);
  sphere->SetRadius(radius);
  return sphere;
}

vtkSmartPointer<vtkActiveImplicitSurface> MakeHeld(vtkSphere* start, vtkSphere* target)
{
  auto filter = MakeShrinkingBall();
  filter->SetInitialFunction(start);
  filter->SetTargetFunction(target);
  filter->SetTargetReach(0.2);
  filter->SetAttraction(5.0);
  filter->SetVolumeControlToExact();
  return filter;
}

int CountWarnings(vtkActiveImplicitSurface* filter)
{
  MessageCapture messages(filter);
  for (const double time : { 0.1, 0.2, 0.5, 1.0 })
  {
    filter->UpdateTimeStep(time);
  }
  return MessageCapture::Count(messages.Warnings, Words);
}

}

TEST(TestExactWarnings, ATargetOutsideIsAWarning)
{
  const auto start = MakeSphere(-0.5, 0.3), away = MakeSphere(0.6, 0.3);
  auto volume = MakeHeld(start, away);
  EXPECT_EQ(CountWarnings(volume), 1) << "warnings in all, with constrained volume";
  EXPECT_LT(GetSkinBounds(volume)[1], 0.0) << "where the skin still is";
  auto area = MakeHeld(start, away);
  area->SetVolumeControlToNone();
  area->SetAreaControlToExact();
  EXPECT_EQ(CountWarnings(area), 1) << "warnings in all, with constrained area";
}

// The skin can follow a target that overlaps it, or that is within TargetReach of it.
TEST(TestExactWarnings, ATargetThatIsMetIsNoWarning)
{
  const auto ball = MakeSphere(0.0, 0.4);
  EXPECT_EQ(CountWarnings(MakeHeld(ball, ball)), 0) << "warnings, at rest on the target";
  EXPECT_EQ(CountWarnings(MakeHeld(ball, MakeSphere(0.0, 0.3))), 0) << "inside, within reach";
  EXPECT_EQ(CountWarnings(MakeHeld(ball, MakeSphere(0.0, 0.7))), 0) << "inside the target";
  EXPECT_EQ(CountWarnings(MakeHeld(ball, MakeSphere(0.2, 0.4))), 0) << "on a sideways motion";
  EXPECT_EQ(CountWarnings(MakeHeld(MakeSphere(-0.4, 0.3), MakeSphere(0.3, 0.3))), 0)
    << "nearly in touch";
}

TEST(TestExactWarnings, ATranslationIsNoWarning)
{
  auto source = MakeMovingBall();
  auto filter = MakeSkinOver(source);
  filter->SetVolumeControlToExact();
  MessageCapture messages(filter);
  for (const double time : { 1.0, 2.0, 3.0, 4.0 })
  {
    filter->UpdateTimeStep(time);
  }
  EXPECT_EQ(MessageCapture::Count(messages.Warnings, Words), 0) << "warnings";
  EXPECT_LT(0.6, GetSkinBounds(filter)[0]) << "where the skin has got to, .8 at its middle";
}

}
