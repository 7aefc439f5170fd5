// Times that the pipeline requests of the filter, and times that the filter requests of its input.

#include "Support/PipelineTools.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkInformation.h"
#include "vtkPolyData.h"
#include "vtkSphere.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

using namespace activesurface;

namespace TestPipeline
{

using SDDP = vtkStreamingDemandDrivenPipeline;

namespace
{

std::vector<double> GetTimeSteps(vtkActiveImplicitSurface* filter, int port)
{
  filter->UpdateInformation();
  vtkInformation* out = filter->GetOutputInformation(port);
  const double* steps = out->Get(SDDP::TIME_STEPS());
  return { steps, steps + out->Length(SDDP::TIME_STEPS()) };
}

double GetDataTime(vtkActiveImplicitSurface* filter)
{
  return filter->GetOutput()->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP());
}

}

TEST(TestPipeline, StepsOfItsOwnArePublished)
{
  auto filter = MakeShrinkingBall();
  filter->SetStartTime(2.0);
  filter->SetTimeStepSize(0.5);
  filter->SetNumberOfTimeSteps(4);
  for (int port = 0; port < 2; ++port)
  {
    const bool isRight = GetTimeSteps(filter, port) == std::vector<double>{ 2.0, 2.5, 3.0, 3.5 };
    EXPECT_TRUE(isRight) << "TIME_STEPS of port " << port;
    const double* range = filter->GetOutputInformation(port)->Get(SDDP::TIME_RANGE());
    EXPECT_EQ(range[0], 2.0) << "first time";
    EXPECT_EQ(range[1], 3.5) << "last time";
  }
  filter->SetNumberOfTimeSteps(2);
  EXPECT_EQ(GetTimeSteps(filter, 0).size(), 2u) << "after a change";
}

TEST(TestPipeline, StepsOfTheInputArePassedOn)
{
  auto source = MakeMovingBall();
  source->SetSteps({ 0.0, 1.0, 4.0 });
  auto filter = MakeSkinOver(source);
  EXPECT_TRUE((GetTimeSteps(filter, 0) == std::vector<double>{ 0.0, 1.0, 4.0 }))
    << "the input's steps";
  filter->RemoveAllInputs();
  EXPECT_EQ(GetTimeSteps(filter, 0).size(), 11u) << "its own without the input";
}

TEST(TestPipeline, ContinuousInputIsAskedAtOwnSteps)
{
  auto source = MakeMovingBall();
  source->SetSteps({});
  source->SetContinuous(true);
  auto filter = MakeSkinOver(source);
  filter->SetTimeStepSize(0.25);
  filter->UpdateTimeStep(0.5);
  EXPECT_EQ(source->GetExecutions(), "0 0.25 0.5 ") << "times asked for";
}

TEST(TestPipeline, WithoutATimeItIsTheFirstStep)
{
  auto source = MakeMovingBall();
  auto filter = MakeSkinOver(source);
  filter->Update();
  EXPECT_EQ(source->GetExecutions(), "0 ") << "times asked for";
  EXPECT_EQ(GetDataTime(filter), 0.0) << "DATA_TIME_STEP";
  EXPECT_GT(filter->GetOutput()->GetNumberOfPolys(), 0.0) << "triangles";
  EXPECT_EQ(filter->GetSubsteps(), 0) << "substeps";
}

TEST(TestPipeline, EachInputStepIsAskedForOnce)
{
  auto source = MakeMovingBall();
  auto filter = MakeSkinOver(source);
  filter->UpdateTimeStep(3.0);
  EXPECT_EQ(source->GetExecutions(), "0 1 2 3 ") << "a jump to 3";
  filter->UpdateTimeStep(4.0);
  EXPECT_EQ(source->GetExecutions(), "0 1 2 3 4 ") << "then to 4";

  source = MakeMovingBall();
  filter = MakeSkinOver(source);
  for (const double time : { 0.0, 0.5, 1.0, 1.25, 1.5, 3.5, 4.0 })
  {
    filter->UpdateTimeStep(time);
    EXPECT_EQ(GetDataTime(filter), time) << "DATA_TIME_STEP";
  }
  EXPECT_EQ(source->GetExecutions(), "0 1 2 3 4 ") << "forward with times in between";
}

TEST(TestPipeline, ForwardRequestsContinue)
{
  auto steps = MakeShrinkingBall();
  for (int i = 0; i <= 10; ++i)
  {
    steps->UpdateTimeStep(0.1 * i);
  }
  auto jump = MakeShrinkingBall();
  jump->UpdateTimeStep(0.1 * 10);
  EXPECT_GT(steps->GetSubsteps(), 0) << "substeps";
  EXPECT_EQ(steps->GetSubsteps(), jump->GetSubsteps()) << "as many substeps as in one go";
  EXPECT_EQ(steps->GetTargetEvaluations(), jump->GetTargetEvaluations()) << "and evaluations";
  EXPECT_TRUE(AreSameSkins(GetBytes(steps), GetBytes(jump))) << "the same bytes";
}

TEST(TestPipeline, SameTimeAgainCostsNothing)
{
  auto filter = MakeShrinkingBall();
  int executions = 0;
  CountExecutions(filter, executions);
  filter->UpdateTimeStep(0.5);
  const auto substeps = filter->GetSubsteps();
  filter->UpdateTimeStep(0.5);
  filter->Update();
  EXPECT_EQ(executions, 1) << "executions";
  filter->ComputeNormalsOff();
  filter->UpdateTimeStep(0.5);
  EXPECT_EQ(executions, 2) << "executions after an output property has changed";
  EXPECT_EQ(filter->GetSubsteps(), substeps) << "substeps";
}

TEST(TestPipeline, EarlierTimeRestarts)
{
  auto source = MakeMovingBall();
  auto filter = MakeSkinOver(source);
  filter->SetCheckpointInterval(10); // more than the number of steps
  const std::string first = GetBytesAt(filter, 1.0);
  filter->UpdateTimeStep(2.0);
  filter->ResetCounters();
  const std::string again = GetBytesAt(filter, 1.0);
  EXPECT_EQ(source->GetExecutions(), "0 1 2 0 1 ") << "times asked for";
  EXPECT_GT(filter->GetSubsteps(), 0) << "substeps";
  EXPECT_TRUE(AreSameSkins(first, again)) << "the same bytes";
}

TEST(TestPipeline, OrderOfRequestsDoesNotMatter)
{
  auto direct = MakeSkinOver(MakeMovingBall());
  const std::string atTwo = GetBytesAt(direct, 2.0);
  auto between = MakeSkinOver(MakeMovingBall());
  between->UpdateTimeStep(2.3);
  const std::string atBetween = GetBytes(between);
  EXPECT_TRUE(atTwo != atBetween) << "the skin moves";

  auto wild = MakeSkinOver(MakeMovingBall());
  for (const double time : { 0.5, 0.25, 1.7, 1.0, 3.9, 0.1, 1.5 })
  {
    wild->UpdateTimeStep(time);
  }
  EXPECT_TRUE(AreSameSkins(GetBytesAt(wild, 2.0), atTwo)) << "a step, after times in between";
  wild->UpdateTimeStep(2.9);
  EXPECT_TRUE(AreSameSkins(GetBytesAt(wild, 2.3), atBetween))
    << "a time in between, after a later one";
  wild->UpdateTimeStep(4.0);
  EXPECT_TRUE(AreSameSkins(GetBytesAt(wild, 2.3), atBetween))
    << "a time in between, after a restart";
}

TEST(TestPipeline, TimesBetweenLeaveTheTrajectoryAlone)
{
  auto filter = MakeShrinkingBall();
  filter->UpdateTimeStep(0.3);
  filter->ResetCounters();
  filter->UpdateTimeStep(0.35);
  const auto branch = filter->GetSubsteps();
  EXPECT_GT(branch, 0) << "substeps of the branch";
  filter->ComputeNormalsOff();
  filter->UpdateTimeStep(0.35);
  EXPECT_EQ(filter->GetSubsteps(), branch) << "the same time in between again";
  filter->ComputeNormalsOn();
  auto direct = MakeShrinkingBall();
  EXPECT_TRUE(AreSameSkins(GetBytesAt(filter, 0.4), GetBytesAt(direct, 0.4)))
    << "the next step's bytes";
}

// 3 * 0.1 is not 0.3. The difference must not cause a branch that ends just before the step.
TEST(TestPipeline, TimesThatDifferByRoundingAreTheStep)
{
  auto filter = MakeShrinkingBall();
  filter->UpdateTimeStep(0.2);
  const std::string before = GetBytesAt(filter, 0.3);
  EXPECT_EQ(GetDataTime(filter), 0.1 * 3) << "DATA_TIME_STEP";
  filter->ResetCounters();
  filter->UpdateTimeStep(0.4);
  const auto substeps = filter->GetSubsteps();
  filter->ResetCounters();
  filter->UpdateTimeStep(0.5);
  EXPECT_EQ(substeps, filter->GetSubsteps()) << "substeps of a step";
  auto exact = MakeShrinkingBall();
  EXPECT_TRUE(AreSameSkins(GetBytesAt(exact, 0.1 * 3), before)) << "the same bytes";
  EXPECT_TRUE(
    AreSameSkins(GetBytesAt(exact, std::nextafter(0.1 * 2, 1.0)), GetBytesAt(exact, 0.1 * 2)))
    << "the same bytes, from above";
}

TEST(TestPipeline, TimesBeyondTheStepsAreTheFirstAndTheLast)
{
  auto filter = MakeSkinOver(MakeMovingBall());
  const std::string first = GetBytesAt(filter, 0.0);
  EXPECT_TRUE(AreSameSkins(GetBytesAt(filter, -3.0), first)) << "before the first";
  EXPECT_TRUE(AreSameSkins(GetBytesAt(filter, std::nan("")), first)) << "no number";
  EXPECT_EQ(GetDataTime(filter), 0.0) << "DATA_TIME_STEP";
  const std::string last = GetBytesAt(filter, 4.0);
  EXPECT_TRUE(AreSameSkins(GetBytesAt(filter, 99.0), last)) << "after the last";
  EXPECT_EQ(GetDataTime(filter), 4.0) << "DATA_TIME_STEP";

  auto own = MakeShrinkingBall();
  const std::string end = GetBytesAt(own, 0.1 * 10);
  EXPECT_TRUE(AreSameSkins(GetBytesAt(own, 7.0), end)) << "after the last of its own";
}

// The first-order distance of vtkSphere, (r^2 - R^2) / 2r, gives r^2 = R^2 + (r0^2 - R^2) e^(-t).
// Five substeps of 0.1 give 0.9^5 instead of e^(-0.5): the radius is smaller by 0.003, 0.05 h.
// Crossings of chords are within h^2 / 8r, 0.02 h.
TEST(TestPipeline, TimeScaleIsMotionTimePerPipelineTime)
{
  auto slow = MakeShrinkingBall();
  slow->SetTimeStepSize(2.5);
  slow->SetStartTime(100.0);
  slow->SetTimeScale(0.04);
  auto plain = MakeShrinkingBall();
  const std::string expected = GetBytesAt(plain, 0.5);
  slow->UpdateTimeStep(112.5);
  const double radius = GetSkinBounds(slow)[1];
  const double exact = std::sqrt(0.16 + (0.36 - 0.16) * std::exp(-0.5));
  EXPECT_NEAR(radius, exact, 0.08 * 0.0625) << "radius after .5 of motion time";
  EXPECT_NEAR(radius, GetSkinBounds(plain)[1], 1e-6) << "as without a scale";
}

TEST(TestPipeline, ProgressRisesToOneAndCanBeStopped)
{
  struct Watch
  {
    double Last = 0.0;
    int Falls = 0;
    int Calls = 0;
    bool Stop = false;
  } watch;
  vtkNew<vtkCallbackCommand> watcher;
  watcher->SetClientData(&watch);
  watcher->SetCallback(
    [](vtkObject* caller, unsigned long, void* data, void*)
    {
      auto filter = static_cast<vtkAlgorithm*>(caller);
      auto seen = static_cast<Watch*>(data);
      const double progress = filter->GetProgress();
      seen->Falls += progress < seen->Last && progress > 0.0 ? 1 : 0;
      seen->Last = progress;
      ++seen->Calls;
      if (seen->Stop && progress > 0.5)
      {
        filter->AbortExecuteOn();
      }
    });
  auto filter = MakeShrinkingBall();
  filter->SetCheckpointInterval(0); // each request repeats the whole motion
  filter->AddObserver(vtkCommand::ProgressEvent, watcher);
  filter->UpdateTimeStep(1.0);
  EXPECT_EQ(watch.Falls, 0) << "falls of the progress";
  EXPECT_EQ(watch.Last, 1.0) << "last progress";
  EXPECT_GT(watch.Calls, 20) << "calls";
  const std::string whole = GetBytes(filter);

  watch = Watch();
  watch.Stop = true;
  filter->SetAttraction(1.01);
  filter->SetAttraction(1.0);
  filter->UpdateTimeStep(0.0);
  filter->UpdateTimeStep(1.0);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0) << "points when aborted";
  watch.Stop = false;
  filter->AbortExecuteOff();
  filter->UpdateTimeStep(1.0);
  EXPECT_TRUE(AreSameSkins(GetBytes(filter), whole)) << "the same bytes after an abort";
}

}
