// Time steps of the input that occur twice.

#include "Check.h"
#include "PipelineTools.h"

#include "vtkExecutive.h"
#include "vtkInformation.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <cmath>
#include <vector>

using namespace activesurface;

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

void EqualNeighboursCountAsOne(Check& check)
{
  vtkNew<ParticleSource> twice;
  twice->SetCloud(MovingBall);
  twice->SetSteps({ 0.0, 0.0, 1.0, 1.0, 1.0, 2.0 });
  auto filter = MakeSkinOver(twice);
  check.True(GetPublishedSteps(filter) == std::vector<double>{ 0.0, 1.0, 2.0 }, "steps");
  Messages messages(filter);
  const std::string bytes = GetBytesAt(filter, 1.5);
  check.Equal(messages.Errors.size(), std::size_t(0), "errors");
  vtkNew<ParticleSource> once;
  once->SetCloud(MovingBall);
  once->SetSteps({ 0.0, 1.0, 2.0 });
  check.True(bytes == GetBytesAt(MakeSkinOver(once), 1.5), "the same bytes as of each once");
}

// All equal: one time, a target that stands still, and the filter's own steps.
void OneTimeManyTimesIsAStaticTarget(Check& check)
{
  vtkNew<ParticleSource> source;
  source->SetCloud(MovingBall);
  source->SetSteps(std::vector<double>(21, 0.25));
  auto filter = MakeSkinOver(source);
  filter->SetStartTime(3.0);
  filter->SetTimeStepSize(0.5);
  filter->SetNumberOfTimeSteps(3);
  check.True(GetPublishedSteps(filter) == std::vector<double>{ 3.0, 3.5, 4.0 }, "steps");
  Messages messages(filter);
  GetBytesAt(filter, 4.0);
  check.Equal(messages.Errors.size(), std::size_t(0), "errors");
  check.Equal(source->GetExecutions(), std::string("0.25 "), "executions");
}

// Neighbours that differ in the last bit are two.
void OnlyExactlyEqualOnesAreMerged(Check& check)
{
  vtkNew<ParticleSource> source;
  source->SetCloud(MovingBall);
  source->SetSteps({ 1.0, std::nextafter(1.0, 2.0), 2.0 });
  check.Equal(GetPublishedSteps(MakeSkinOver(source)).size(), std::size_t(3), "steps");
}

int main(int argc, char** argv)
{
  return RunFacts(argc, argv,
    { { "EqualNeighboursCountAsOne", EqualNeighboursCountAsOne },
      { "OneTimeManyTimesIsAStaticTarget", OneTimeManyTimesIsAStaticTarget },
      { "OnlyExactlyEqualOnesAreMerged", OnlyExactlyEqualOnesAreMerged } });
}
