// An incomplete motion keeps all finished substeps. Resuming gives a result bitwise identical to an
// undisturbed motion.

#include "Support/MessageCapture.h"
#include "Support/PipelineTools.h"

#include "vtkAlgorithm.h"
#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkExecutive.h"
#include "vtkPolyData.h"
#include "vtkSphere.h"

#include <gtest/gtest.h>

#include <string>

using namespace activesurface;

namespace TestKeptState
{

namespace
{

constexpr int Few = 10000; // active voxels: radius 0.6: 7200, 0.9: 16000
constexpr int Many = 60000;

// A ball of radius 0.6 that becomes one of 0.9, in steps of 1.
vtkSmartPointer<vtkActiveImplicitSurface> MakeGrowingBall(int maximum)
{
  auto filter = MakeShrinkingBall();
  vtkNew<vtkSphere> large;
  large->SetRadius(0.9);
  filter->SetTargetFunction(large);
  filter->SetModelBounds(-0.65, 0.65, -0.65, 0.65, -0.65, 0.65);
  filter->SetTimeStepSize(1.0);
  filter->SetMaximumNumberOfActiveVoxels(maximum);
  return filter;
}

// Checks that an update fails with these words and leaves no output.
void Fails(vtkActiveImplicitSurface* filter, double time, const std::string& words)
{
  MessageCapture messages(filter);
  filter->UpdateTimeStep(time);
  EXPECT_EQ(MessageCapture::Count(messages.Errors, words), 1) << "errors with \"" << words << "\"";
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0) << "points";
}

// A filter that has failed between the steps 0 and 1.
vtkSmartPointer<vtkActiveImplicitSurface> MakeInterrupted()
{
  auto filter = MakeGrowingBall(Few);
  Fails(filter, 2.0, "MaximumNumberOfActiveVoxels");
  filter->SetMaximumNumberOfActiveVoxels(Many);
  return filter;
}

// Aborts after `Left` substeps.
struct Stopper
{
  int Left;

  static void Count(vtkObject* caller, unsigned long, void* self, void*)
  {
    if (--static_cast<Stopper*>(self)->Left < 0)
    {
      static_cast<vtkAlgorithm*>(caller)->AbortExecuteOn();
    }
  }

  void Watch(vtkAlgorithm* filter)
  {
    vtkNew<vtkCallbackCommand> watcher;
    watcher->SetClientData(this);
    watcher->SetCallback(Count);
    filter->AddObserver(vtkCommand::ProgressEvent, watcher);
  }
};

}

TEST(TestKeptState, RaisingTheMaximumGoesOn)
{
  auto direct = MakeGrowingBall(Many);
  const std::string bytes = GetBytesAt(direct, 2.0);
  auto filter = MakeGrowingBall(Few);
  Fails(filter, 2.0, "MaximumNumberOfActiveVoxels");
  const auto before = filter->GetSubsteps();
  EXPECT_GT(before, 0) << "substeps before the error";
  EXPECT_LT(before, direct->GetSubsteps()) << "substeps before the error";
  filter->SetMaximumNumberOfActiveVoxels(Many);
  EXPECT_TRUE(AreSameSkins(GetBytesAt(filter, 2.0), bytes)) << "the same bytes as without an error";
  EXPECT_EQ(filter->GetSubsteps(), direct->GetSubsteps()) << "substeps in all";
}

// The limit is also checked before a substep, so the second update makes none.
TEST(TestKeptState, ErrorsOneAfterTheOtherGainNothing)
{
  auto direct = MakeGrowingBall(Many);
  const std::string bytes = GetBytesAt(direct, 1.0);
  auto filter = MakeGrowingBall(Few);
  Fails(filter, 1.0, "MaximumNumberOfActiveVoxels");
  const auto once = filter->GetSubsteps();
  Fails(filter, 1.0, "MaximumNumberOfActiveVoxels");
  EXPECT_EQ(filter->GetSubsteps(), once) << "substeps after the second error";
  filter->SetMaximumNumberOfActiveVoxels(Many);
  EXPECT_TRUE(AreSameSkins(GetBytesAt(filter, 1.0), bytes)) << "the same bytes as without an error";
  EXPECT_EQ(filter->GetSubsteps(), direct->GetSubsteps()) << "substeps in all";
}

TEST(TestKeptState, StoppedMotionGoesOn)
{
  auto direct = MakeGrowingBall(Many);
  const std::string bytes = GetBytesAt(direct, 2.0);
  auto filter = MakeGrowingBall(Many);
  filter->Update();
  Stopper stopper = { 5 };
  stopper.Watch(filter);
  filter->UpdateTimeStep(2.0);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0) << "points when stopped";
  const auto before = filter->GetSubsteps();
  EXPECT_GT(before, 0) << "substeps before it";
  stopper.Left = 1000;
  filter->AbortExecuteOff();
  EXPECT_TRUE(AreSameSkins(GetBytesAt(filter, 2.0), bytes)) << "the same bytes as without a stop";
  EXPECT_EQ(filter->GetSubsteps(), direct->GetSubsteps()) << "substeps in all";
}

TEST(TestKeptState, StoppedStartIsMadeAgain)
{
  auto filter = MakeGrowingBall(Many);
  Stopper stopper = { 5 };
  stopper.Watch(filter);
  filter->UpdateTimeStep(1.0);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0) << "points when stopped";
  EXPECT_EQ(filter->GetSubsteps(), 0) << "substeps";
  stopper.Left = 1000;
  filter->AbortExecuteOff();
  EXPECT_TRUE(AreSameSkins(GetBytesAt(filter, 1.0), GetBytesAt(MakeGrowingBall(Many), 1.0)))
    << "the same bytes";
}

// No branch starts from a state between two steps: the filter returns to the step before.
TEST(TestKeptState, TimesBeforeTheNextStepStartAnew)
{
  auto direct = MakeGrowingBall(Many);
  for (const double time : { 0.0, 0.01, 0.9 })
  {
    auto filter = MakeInterrupted();
    const std::string name = std::to_string(time);
    EXPECT_TRUE(AreSameSkins(GetBytesAt(filter, time), GetBytesAt(direct, time)))
      << "the same bytes at " << name;
    EXPECT_TRUE(AreSameSkins(GetBytesAt(filter, 1.0), GetBytesAt(direct, 1.0))) << "and then at 1";
  }
}

TEST(TestKeptState, InterruptedBranchLeavesTheStepAlone)
{
  auto direct = MakeGrowingBall(Many);
  const std::string between = GetBytesAt(direct, 0.9);
  const auto substeps = direct->GetSubsteps();
  const std::string atOne = GetBytesAt(direct, 1.0);
  auto filter = MakeGrowingBall(Few);
  const std::string start = GetBytesAt(filter, 0.0);
  Fails(filter, 0.9, "MaximumNumberOfActiveVoxels");
  filter->SetMaximumNumberOfActiveVoxels(Many);
  EXPECT_TRUE(AreSameSkins(GetBytesAt(filter, 0.9), between)) << "the same bytes between the steps";
  EXPECT_EQ(filter->GetSubsteps(), substeps) << "substeps of the branch";
  EXPECT_TRUE(AreSameSkins(GetBytesAt(filter, 0.0), start)) << "the same bytes at the step";
  EXPECT_EQ(filter->GetSubsteps(), substeps) << "which was kept";
  EXPECT_TRUE(AreSameSkins(GetBytesAt(filter, 1.0), atOne)) << "the same bytes at the next step";
}

// VTK regards the failed request for step 3 as fulfilled, so the filter first requests step 2
// again.
TEST(TestKeptState, InputThatFailsKeepsTheLastStep)
{
  auto source = MakeMovingBall();
  auto filter = MakeSkinOver(source);
  source->SetFailingExecution(3);
  Fails(filter, 4.0, "update of the input failed at the time step 3");
  EXPECT_EQ(source->GetExecutions(), "0 1 2 3 ") << "times asked for";
  source->SetFailingExecution(-1);
  const std::string bytes = GetBytesAt(filter, 4.0);
  EXPECT_EQ(source->GetExecutions(), "0 1 2 3 2 3 4 ") << "times asked for in all";
  auto direct = MakeSkinOver(MakeMovingBall());
  EXPECT_TRUE(AreSameSkins(bytes, GetBytesAt(direct, 4.0))) << "the same bytes as without an error";
  EXPECT_EQ(filter->GetSubsteps(), direct->GetSubsteps()) << "substeps in all";
}

// The step that fails is the one that the pipeline requests.
TEST(TestKeptState, NextStepThatFailsKeepsTheOneBefore)
{
  auto source = MakeMovingBall();
  auto filter = MakeSkinOver(source);
  filter->UpdateTimeStep(2.0);
  source->SetFailingExecution(3);
  MessageCapture messages(filter);
  filter->UpdateTimeStep(3.0);
  EXPECT_EQ(source->GetExecutions(), "0 1 2 3 ") << "times asked for";
  source->SetFailingExecution(-1);
  const std::string bytes = GetBytesAt(filter, 3.0);
  EXPECT_EQ(source->GetExecutions(), "0 1 2 3 2 3 ") << "times asked for in all";
  auto direct = MakeSkinOver(MakeMovingBall());
  EXPECT_TRUE(AreSameSkins(bytes, GetBytesAt(direct, 3.0))) << "the same bytes as without an error";
  EXPECT_EQ(filter->GetSubsteps(), direct->GetSubsteps()) << "substeps in all";
}

// Without an earlier result VTK would pass on the empty data of the failure.
TEST(TestKeptState, FirstStepThatFailsIsMadeAgain)
{
  for (const double time : { 0.0, 3.0 })
  {
    auto source = MakeMovingBall();
    auto filter = MakeSkinOver(source);
    source->SetFailingExecution(0);
    MessageCapture messages(filter);
    filter->UpdateTimeStep(time);
    EXPECT_EQ(source->GetExecutions(), "0 ") << "times asked for";
    source->SetFailingExecution(-1);
    const std::string bytes = GetBytesAt(filter, time);
    EXPECT_EQ(source->GetExecutions().substr(0, 6), "0 1 0 ") << "times asked for then";
    auto direct = MakeSkinOver(MakeMovingBall());
    EXPECT_TRUE(AreSameSkins(bytes, GetBytesAt(direct, time))) << "as without an error at " << time;
  }
}

TEST(TestKeptState, ChangedPropertyStartsAnewAfterAnError)
{
  auto filter = MakeInterrupted();
  auto direct = MakeGrowingBall(Many);
  filter->SetAttraction(1.5);
  direct->SetAttraction(1.5);
  EXPECT_TRUE(AreSameSkins(GetBytesAt(filter, 1.0), GetBytesAt(direct, 1.0))) << "the same bytes";
}

}
