// Time steps of the input that occur twice.

#include "Support/MessageCapture.h"
#include "Support/PipelineTools.h"

#include "vtkExecutive.h"
#include "vtkInformation.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

using namespace activesurface;

namespace TestInputSteps
{

namespace
{

using SDDP = vtkStreamingDemandDrivenPipeline;

std::vector<double> GetPublishedSteps(vtkActiveImplicitSurface* filter)
{
  filter->UpdateInformation();
  vtkInformation* output = filter->GetOutputInformation(0);
  const double* first = output->Get(SDDP::TIME_STEPS());
  return { first, first + output->Length(SDDP::TIME_STEPS()) };
}

}

TEST(TestInputSteps, EqualNeighboursCountAsOne)
{
  vtkNew<ParticleSource> twice;
  twice->SetCloud(MovingBall);
  twice->SetSteps({ 0.0, 0.0, 1.0, 1.0, 1.0, 2.0 });
  auto filter = MakeSkinOver(twice);
  EXPECT_TRUE((GetPublishedSteps(filter) == std::vector<double>{ 0.0, 1.0, 2.0 })) << "steps";
  MessageCapture messages(filter);
  const std::string bytes = GetBytesAt(filter, 1.5);
  EXPECT_EQ(messages.Errors.size(), std::size_t(0)) << "errors";
  vtkNew<ParticleSource> once;
  once->SetCloud(MovingBall);
  once->SetSteps({ 0.0, 1.0, 2.0 });
  EXPECT_TRUE(bytes == GetBytesAt(MakeSkinOver(once), 1.5)) << "the same bytes as of each once";
}

// An input whose steps are all equal is static, so the filter publishes its own steps.
TEST(TestInputSteps, OneTimeManyTimesIsAStaticTarget)
{
  vtkNew<ParticleSource> source;
  source->SetCloud(MovingBall);
  source->SetSteps(std::vector<double>(21, 0.25));
  auto filter = MakeSkinOver(source);
  filter->SetStartTime(3.0);
  filter->SetTimeStepSize(0.5);
  filter->SetNumberOfTimeSteps(3);
  EXPECT_TRUE((GetPublishedSteps(filter) == std::vector<double>{ 3.0, 3.5, 4.0 })) << "steps";
  MessageCapture messages(filter);
  GetBytesAt(filter, 4.0);
  EXPECT_EQ(messages.Errors.size(), std::size_t(0)) << "errors";
  EXPECT_EQ(source->GetExecutions(), std::string("0.25 ")) << "executions";
}

TEST(TestInputSteps, OnlyExactlyEqualOnesAreMerged)
{
  vtkNew<ParticleSource> source;
  source->SetCloud(MovingBall);
  source->SetSteps({ 1.0, std::nextafter(1.0, 2.0), 2.0 });
  EXPECT_EQ(GetPublishedSteps(MakeSkinOver(source)).size(), std::size_t(3)) << "steps";
}

}
