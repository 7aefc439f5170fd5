// History of a skin: one row for each time step, whatever requests came in between.

#include "Support/HistoryTools.h"
#include "Support/MessageCapture.h"
#include "Support/PipelineTools.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkMassProperties.h"
#include "vtkPolyData.h"
#include "vtkSphere.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"
#include "vtkVariant.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace activesurface;

namespace TestHistory
{

namespace
{

std::string GetHistoryAt(vtkActiveImplicitSurface* filter, double time)
{
  filter->UpdateTimeStep(time);
  return GetHistoryText(filter);
}

// Two particles that meet and separate: the skin has two bodies, then one, then two.
vtkSmartPointer<vtkActiveImplicitSurface> MakeMeeting()
{
  vtkNew<ParticleSource> source;
  source->SetCloud(
    [](double time)
    {
      const double apart = 0.1 + 0.1 * std::abs(2.0 - time);
      return std::vector<Particle>{ { -apart, 0.01, 0.02, 1 }, { apart, 0.03, -0.01, 2 } };
    });
  source->SetSteps({ 0.0, 1.0, 2.0, 3.0, 4.0 });
  auto filter = MakeSkinOver(source);
  filter->SetParticleModelToSum();
  filter->SetTimeIntegrationToExplicit();
  filter->SetKernelRadius(0.4);
  filter->SetTension(0.001);
  return filter;
}

// A ball that does not overlap its target.
vtkSmartPointer<vtkActiveImplicitSurface> MakeVanishing()
{
  auto filter = MakeShrinkingBall();
  vtkNew<vtkSphere> far;
  far->SetCenter(3.0, 0.0, 0.0);
  filter->SetTargetFunction(far);
  filter->SetTimeStepSize(0.5);
  return filter;
}

}

TEST(TestHistory, EachStepHasARow)
{
  auto filter = MakeShrinkingBall();
  filter->UpdateTimeStep(0.5);
  vtkTable* history = filter->GetHistory();
  std::string names;
  for (vtkIdType column = 0; column < history->GetNumberOfColumns(); ++column)
  {
    names += std::string(history->GetColumnName(column)) + " ";
  }
  EXPECT_EQ(names,
    "Time Substeps MaxSpeed Area Volume ActiveVoxels Components Voids EulerCharacteristic Outside "
    "Event ")
    << "columns";
  EXPECT_EQ(CountRows(filter), 6) << "rows";
  for (int row = 0; row < CountRows(filter); ++row)
  {
    const std::string name = ", row " + std::to_string(row);
    EXPECT_EQ(GetNumber(filter, row, "Time"), 0.1 * row) << "Time" << name;
    EXPECT_EQ(GetNumber(filter, row, "Substeps") > 0, row > 0) << "Substeps > 0" << name;
    EXPECT_EQ(DescribeTopology(filter, row), "1 0 2") << "bodies, voids, Euler number" << name;
    EXPECT_EQ(history->GetValueByName(row, "Event").ToString(), "") << "Event" << name;
    EXPECT_LT(row == 0 ? 0.0 : GetNumber(filter, row, "Volume"),
      GetNumber(filter, std::max(row - 1, 0), "Volume"))
      << "Volume falls" << name;
    // About 20 (d / h)^2, as in the documentation of MaximumNumberOfActiveVoxels. Balls of 0.4 and
    // 0.6 have 3300 and 7400.
    EXPECT_NEAR(GetNumber(filter, row, "ActiveVoxels"), 5300, 2900) << "ActiveVoxels" << name;
  }
}

// The speed at the start of a step is Attraction F / |grad F| = (r^2 - R^2) / 2r, at the skin's
// radius at that time. The target's distance is evaluated at chords, within h^2 / 8r = 0.001. The
// maximum over the nodes' crossings adds as much.
TEST(TestHistory, MaxSpeedIsThatOfTheStep)
{
  auto filter = MakeShrinkingBall();
  filter->UpdateTimeStep(1.0);
  EXPECT_EQ(GetNumber(filter, 0, "MaxSpeed"), 0.0) << "at the start";
  for (int row = 1; row < CountRows(filter); ++row)
  {
    const double volume = GetNumber(filter, row - 1, "Volume");
    const double radius = std::cbrt(3.0 * volume / (4.0 * 3.14159265358979));
    EXPECT_NEAR(
      GetNumber(filter, row, "MaxSpeed"), (radius * radius - 0.16) / (2.0 * radius), 0.002 + 0.0015)
      << "row " << row;
  }
}

TEST(TestHistory, SubstepsAddUp)
{
  for (const auto& filter : { MakeShrinkingBall(), MakeMeeting() })
  {
    double sum = 0.0;
    filter->UpdateTimeStep(4.0);
    for (int row = 0; row < CountRows(filter); ++row)
    {
      sum += GetNumber(filter, row, "Substeps");
    }
    EXPECT_GT(sum, 0.0) << "substeps of all rows";
    EXPECT_EQ(sum, double(filter->GetSubsteps())) << "and of the filter";
  }
}

// The points of the mesh have single precision.
TEST(TestHistory, AreaAndVolumeAreThoseOfTheMesh)
{
  for (const auto& filter : { MakeShrinkingBall(), MakeMeeting() })
  {
    for (const double time : { 0.0, 1.0, 2.0, 4.0 }) // the ball has only times 0 and 1
    {
      filter->UpdateTimeStep(time);
      vtkNew<vtkMassProperties> mass;
      mass->SetInputData(filter->GetOutput());
      const int row = CountRows(filter) - 1;
      const std::string name = " at " + std::to_string(time);
      EXPECT_NEAR(GetNumber(filter, row, "Area") / mass->GetSurfaceArea(), 1.0, 1e-4)
        << "area" << name;
      EXPECT_NEAR(GetNumber(filter, row, "Volume") / mass->GetVolume(), 1.0, 1e-4)
        << "volume" << name;
    }
  }
}

TEST(TestHistory, OrderOfRequestsDoesNotMatter)
{
  auto forward = MakeMeeting();
  std::vector<std::string> texts;
  for (int step = 0; step <= 4; ++step)
  {
    texts.push_back(GetHistoryAt(forward, step));
  }
  EXPECT_EQ(texts[2].substr(0, texts[1].size()), texts[1]) << "what is there stays";
  for (int step = 4; step >= 0; --step)
  {
    EXPECT_EQ(GetHistoryAt(forward, step), texts[step]) << "backward, " << step;
  }
  auto jump = MakeMeeting();
  EXPECT_EQ(GetHistoryAt(jump, 4.0), texts[4]) << "at once";
  auto wild = MakeMeeting();
  for (const int step : { 3, 1, 1, 4, 0, 2, 3 })
  {
    EXPECT_EQ(GetHistoryAt(wild, step), texts[step]) << "at random, " << step;
  }
}

TEST(TestHistory, TimesBetweenLeaveNoRow)
{
  auto direct = MakeMeeting();
  const std::string atOne = GetHistoryAt(direct, 1.0);
  const std::string atFour = GetHistoryAt(direct, 4.0);
  auto filter = MakeMeeting();
  for (const double time : { 1.5, 1.25, 1.75, 1.0, 1.9 })
  {
    EXPECT_EQ(GetHistoryAt(filter, time), atOne) << "at " << time;
  }
  filter->UpdateTimeStep(3.5);
  filter->UpdateTimeStep(0.5);
  filter->UpdateTimeStep(2.5);
  EXPECT_EQ(GetHistoryAt(filter, 4.0), atFour) << "at the end";
}

TEST(TestHistory, ThreadsDoNotChangeTheRows)
{
  std::string expected;
  for (const int threads : { 1, 2, 4 })
  {
    auto filter = MakeMeeting();
    filter->SetNumberOfThreads(threads);
    const std::string text = GetHistoryAt(filter, 4.0);
    expected = expected.empty() ? text : expected;
    EXPECT_EQ(text, expected) << threads << " threads";
  }
}

TEST(TestHistory, ErrorAtTheStartLeavesNoTrace)
{
  auto direct = MakeMeeting();
  const std::string expected = GetHistoryAt(direct, 4.0);
  const auto atStart = static_cast<vtkIdType>(GetNumber(direct, 0, "ActiveVoxels"));
  auto filter = MakeMeeting();
  filter->UpdateTimeStep(1.0);
  MessageCapture messages(filter);
  filter->SetAttraction(9.0); // restarts, with a voxel too many
  filter->SetMaximumNumberOfActiveVoxels(atStart - 1);
  filter->UpdateTimeStep(2.0);
  EXPECT_EQ(MessageCapture::Count(messages.Errors, "vtkActiveImplicitSurface ("), 1)
    << "errors of its own";
  EXPECT_EQ(CountRows(filter), 0) << "rows after an error";
  EXPECT_EQ(filter->GetHistory()->GetNumberOfColumns(), 0) << "columns after an error";
  filter->SetMaximumNumberOfActiveVoxels(1000000);
  filter->SetAttraction(10.0);
  EXPECT_EQ(GetHistoryAt(filter, 4.0), expected) << "after the correction";
}

// Growing ball, as in TestKeptState: the finished substeps of the failed step count once.
TEST(TestHistory, ErrorWithinAStepLeavesNoTrace)
{
  const auto make = []
  {
    auto filter = MakeShrinkingBall();
    vtkNew<vtkSphere> large;
    large->SetRadius(0.9);
    filter->SetTargetFunction(large);
    filter->SetTimeStepSize(1.0);
    return filter;
  };
  auto direct = make();
  const std::string expected = GetHistoryAt(direct, 2.0);
  auto filter = make();
  filter->SetMaximumNumberOfActiveVoxels(10000);
  MessageCapture messages(filter);
  filter->UpdateTimeStep(2.0);
  EXPECT_EQ(MessageCapture::Count(messages.Errors, "vtkActiveImplicitSurface ("), 1)
    << "errors of its own";
  EXPECT_GT(filter->GetSubsteps(), 0) << "substeps before it";
  EXPECT_EQ(CountRows(filter), 0) << "rows after an error";
  filter->SetMaximumNumberOfActiveVoxels(60000);
  EXPECT_EQ(GetHistoryAt(filter, 2.0), expected) << "after the correction";
}

TEST(TestHistory, AbortLeavesNoTrace)
{
  auto direct = MakeMeeting();
  const std::string expected = GetHistoryAt(direct, 4.0);
  auto filter = MakeMeeting();
  vtkNew<vtkCallbackCommand> watcher;
  watcher->SetCallback(
    [](vtkObject* caller, unsigned long, void*, void*)
    {
      auto seen = static_cast<vtkAlgorithm*>(caller);
      seen->SetAbortExecute(seen->GetProgress() > 0.4);
    });
  const unsigned long tag = filter->AddObserver(vtkCommand::ProgressEvent, watcher);
  filter->UpdateTimeStep(4.0);
  EXPECT_EQ(CountRows(filter), 0) << "rows when stopped";
  EXPECT_GT(filter->GetSubsteps(), 0) << "substeps before it";
  EXPECT_LT(filter->GetSubsteps(), direct->GetSubsteps()) << "substeps before it";
  filter->RemoveObserver(tag);
  filter->AbortExecuteOff();
  EXPECT_EQ(GetHistoryAt(filter, 4.0), expected) << "afterwards";
}

TEST(TestHistory, HistoryAloneCanBeAskedFor)
{
  auto direct = MakeShrinkingBall();
  const std::string first = GetHistoryAt(direct, 0.0);
  const std::string expected = GetHistoryAt(direct, 0.5);
  auto filter = MakeShrinkingBall();
  filter->Update(2);
  EXPECT_EQ(GetHistoryText(filter), first) << "without a time it is the first step";
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0) << "points of the skin, not asked for";
  filter->UpdateInformation();
  filter->GetOutputInformation(2)->Set(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP(), 0.5);
  filter->Update(2);
  EXPECT_EQ(GetHistoryText(filter), expected) << "at .5";
  EXPECT_EQ(filter->GetHistory()->GetInformation()->Get(vtkDataObject::DATA_TIME_STEP()), 0.5)
    << "DATA_TIME_STEP";
  const auto substeps = filter->GetSubsteps();
  EXPECT_TRUE(AreSameSkins(GetBytesAt(filter, 0.5), GetBytes(direct)))
    << "the skin, asked for afterwards";
  EXPECT_EQ(filter->GetSubsteps(), substeps) << "costs no substep";
  EXPECT_EQ(GetHistoryText(filter), expected) << "and leaves the history";
}

TEST(TestHistory, EmptySkinsHaveZeros)
{
  auto filter = MakeVanishing();
  filter->UpdateTimeStep(5.0);
  const int last = CountRows(filter) - 1;
  EXPECT_EQ(last, 10) << "last row";
  EXPECT_EQ(DescribeTopology(filter, 0), "1 0 2") << "at first";
  for (const char* column : { "Area", "Volume", "ActiveVoxels", "Components", "Voids",
         "EulerCharacteristic", "Substeps", "MaxSpeed" })
  {
    EXPECT_EQ(GetNumber(filter, last, column), 0.0) << std::string(column) << " in the end";
  }
  EXPECT_EQ(GetNumber(filter, last, "Time"), 5.0) << "Time in the end";

  vtkNew<ParticleSource> none;
  none->SetCloud([](double) { return std::vector<Particle>(); });
  none->SetSteps({ 0.0, 1.0, 2.0 });
  auto empty = MakeSkinOver(none);
  empty->UpdateTimeStep(2.0);
  EXPECT_EQ(CountRows(empty), 3) << "rows of a skin that never was";
  for (int row = 0; row < CountRows(empty); ++row)
  {
    EXPECT_EQ(DescribeTopology(empty, row), "0 0 0") << "row " << row;
    EXPECT_EQ(GetNumber(empty, row, "Area"), 0.0) << "area, row " << row;
  }
}

TEST(TestHistory, ChangedPropertyStartsTheHistoryAnew)
{
  auto filter = MakeShrinkingBall();
  filter->UpdateTimeStep(0.5);
  filter->SetTension(0.01);
  auto direct = MakeShrinkingBall();
  direct->SetTension(0.01);
  EXPECT_EQ(GetHistoryAt(filter, 0.3), GetHistoryAt(direct, 0.3)) << "rows";
}

}
