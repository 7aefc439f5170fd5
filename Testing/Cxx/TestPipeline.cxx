// What times the pipeline asks of the filter, and what the filter asks of its input: how often, in
// which order, and that the result does not depend on it.

#include "Check.h"
#include "PipelineTools.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkInformation.h"
#include "vtkPolyData.h"
#include "vtkSphere.h"
#include "vtkStreamingDemandDrivenPipeline.h"

using namespace activesurface;
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

void StepsOfItsOwnArePublished(Check& check)
{
  auto filter = MakeShrinkingBall();
  filter->SetStartTime(2.0);
  filter->SetTimeStepSize(0.5);
  filter->SetNumberOfTimeSteps(4);
  for (int port = 0; port < 2; ++port)
  {
    const bool isRight = GetTimeSteps(filter, port) == std::vector<double>{ 2.0, 2.5, 3.0, 3.5 };
    check.True(isRight, "TIME_STEPS of port " + std::to_string(port));
    const double* range = filter->GetOutputInformation(port)->Get(SDDP::TIME_RANGE());
    check.Equal(range[0], 2.0, "first time");
    check.Equal(range[1], 3.5, "last time");
  }
  filter->SetNumberOfTimeSteps(2);
  check.Equal(GetTimeSteps(filter, 0).size(), std::size_t(2), "after a change");
}

void StepsOfTheInputArePassedOn(Check& check)
{
  auto source = MakeMovingBall();
  source->SetSteps({ 0.0, 1.0, 4.0 });
  auto filter = MakeSkinOver(source);
  check.True(GetTimeSteps(filter, 0) == std::vector<double>{ 0.0, 1.0, 4.0 }, "the input's steps");
  filter->RemoveAllInputs();
  check.Equal(GetTimeSteps(filter, 0).size(), std::size_t(11), "its own without the input");
}

void ContinuousInputIsAskedAtOwnSteps(Check& check)
{
  auto source = MakeMovingBall();
  source->SetSteps({});
  source->SetContinuous(true);
  auto filter = MakeSkinOver(source);
  filter->SetTimeStepSize(0.25);
  filter->UpdateTimeStep(0.5);
  check.Equal(source->GetExecutions(), "0 0.25 0.5 ", "times asked for");
}

void WithoutATimeItIsTheFirstStep(Check& check)
{
  auto source = MakeMovingBall();
  auto filter = MakeSkinOver(source);
  filter->Update();
  check.Equal(source->GetExecutions(), "0 ", "times asked for");
  check.Equal(GetDataTime(filter), 0.0, "DATA_TIME_STEP");
  check.Less(0.0, filter->GetOutput()->GetNumberOfPolys(), "triangles");
  check.Equal(filter->GetSubsteps(), 0, "substeps");
}

void EachInputStepIsAskedForOnce(Check& check)
{
  auto source = MakeMovingBall();
  auto filter = MakeSkinOver(source);
  filter->UpdateTimeStep(3.0);
  check.Equal(source->GetExecutions(), "0 1 2 3 ", "a jump to 3");
  filter->UpdateTimeStep(4.0);
  check.Equal(source->GetExecutions(), "0 1 2 3 4 ", "then to 4");

  source = MakeMovingBall();
  filter = MakeSkinOver(source);
  for (const double time : { 0.0, 0.5, 1.0, 1.25, 1.5, 3.5, 4.0 })
  {
    filter->UpdateTimeStep(time);
    check.Equal(GetDataTime(filter), time, "DATA_TIME_STEP");
  }
  check.Equal(source->GetExecutions(), "0 1 2 3 4 ", "forward with times in between");
}

void ForwardRequestsContinue(Check& check)
{
  auto steps = MakeShrinkingBall();
  for (int i = 0; i <= 10; ++i)
  {
    steps->UpdateTimeStep(0.1 * i);
  }
  auto jump = MakeShrinkingBall();
  jump->UpdateTimeStep(0.1 * 10);
  check.Less(0, steps->GetSubsteps(), "substeps");
  check.Equal(steps->GetSubsteps(), jump->GetSubsteps(), "as many substeps as in one go");
  check.Equal(steps->GetTargetEvaluations(), jump->GetTargetEvaluations(), "and evaluations");
  check.True(GetBytes(steps) == GetBytes(jump), "the same bytes");
}

void SameTimeAgainCostsNothing(Check& check)
{
  auto filter = MakeShrinkingBall();
  int executions = 0;
  CountExecutions(filter, executions);
  filter->UpdateTimeStep(0.5);
  const auto substeps = filter->GetSubsteps();
  filter->UpdateTimeStep(0.5);
  filter->Update();
  check.Equal(executions, 1, "executions");
  filter->ComputeNormalsOff();
  filter->UpdateTimeStep(0.5);
  check.Equal(executions, 2, "executions after an output property has changed");
  check.Equal(filter->GetSubsteps(), substeps, "substeps");
}

void EarlierTimeRestarts(Check& check)
{
  auto source = MakeMovingBall();
  auto filter = MakeSkinOver(source);
  const std::string first = GetBytesAt(filter, 1.0);
  filter->UpdateTimeStep(2.0);
  filter->ResetCounters();
  const std::string again = GetBytesAt(filter, 1.0);
  check.Equal(source->GetExecutions(), "0 1 2 0 1 ", "times asked for");
  check.Less(0, filter->GetSubsteps(), "substeps");
  check.True(first == again, "the same bytes");
}

// The skin at a time depends on that time alone, to the byte.
void OrderOfRequestsDoesNotMatter(Check& check)
{
  auto direct = MakeSkinOver(MakeMovingBall());
  const std::string atTwo = GetBytesAt(direct, 2.0);
  auto between = MakeSkinOver(MakeMovingBall());
  between->UpdateTimeStep(2.3);
  const std::string atBetween = GetBytes(between);
  check.True(atTwo != atBetween, "the skin moves");

  auto wild = MakeSkinOver(MakeMovingBall());
  for (const double time : { 0.5, 0.25, 1.7, 1.0, 3.9, 0.1, 1.5 })
  {
    wild->UpdateTimeStep(time);
  }
  check.True(GetBytesAt(wild, 2.0) == atTwo, "a step, after times in between");
  wild->UpdateTimeStep(2.9);
  check.True(GetBytesAt(wild, 2.3) == atBetween, "a time in between, after a later one");
  wild->UpdateTimeStep(4.0);
  check.True(GetBytesAt(wild, 2.3) == atBetween, "a time in between, after a restart");
}

void TimesBetweenLeaveTheTrajectoryAlone(Check& check)
{
  auto filter = MakeShrinkingBall();
  filter->UpdateTimeStep(0.3);
  filter->ResetCounters();
  filter->UpdateTimeStep(0.35);
  const auto branch = filter->GetSubsteps();
  check.Less(0, branch, "substeps of the branch");
  filter->ComputeNormalsOff();
  filter->UpdateTimeStep(0.35);
  check.Equal(filter->GetSubsteps(), branch, "the same time in between again");
  filter->ComputeNormalsOn();
  auto direct = MakeShrinkingBall();
  check.True(GetBytesAt(filter, 0.4) == GetBytesAt(direct, 0.4), "the next step's bytes");
}

// 3 * .1 is not .3: that would be a branch to almost the next step, and the step again.
void TimesThatDifferByRoundingAreTheStep(Check& check)
{
  auto filter = MakeShrinkingBall();
  filter->UpdateTimeStep(0.2);
  const std::string before = GetBytesAt(filter, 0.3);
  check.Equal(GetDataTime(filter), 0.1 * 3, "DATA_TIME_STEP");
  filter->ResetCounters();
  filter->UpdateTimeStep(0.4);
  const auto substeps = filter->GetSubsteps();
  filter->ResetCounters();
  filter->UpdateTimeStep(0.5);
  check.Equal(substeps, filter->GetSubsteps(), "substeps of a step");
  auto exact = MakeShrinkingBall();
  check.True(GetBytesAt(exact, 0.1 * 3) == before, "the same bytes");
  check.True(GetBytesAt(exact, std::nextafter(0.1 * 2, 1.0)) == GetBytesAt(exact, 0.1 * 2),
    "the same bytes, from above");
}

void TimesBeyondTheStepsAreTheFirstAndTheLast(Check& check)
{
  auto filter = MakeSkinOver(MakeMovingBall());
  const std::string first = GetBytesAt(filter, 0.0);
  check.True(GetBytesAt(filter, -3.0) == first, "before the first");
  check.True(GetBytesAt(filter, std::nan("")) == first, "no number");
  check.Equal(GetDataTime(filter), 0.0, "DATA_TIME_STEP");
  const std::string last = GetBytesAt(filter, 4.0);
  check.True(GetBytesAt(filter, 99.0) == last, "after the last");
  check.Equal(GetDataTime(filter), 4.0, "DATA_TIME_STEP");

  auto own = MakeShrinkingBall();
  const std::string end = GetBytesAt(own, 0.1 * 10);
  check.True(GetBytesAt(own, 7.0) == end, "after the last of its own");
}

// The first-order distance of vtkSphere, (r^2 - R^2) / 2r, gives r^2 = R^2 + (r0^2 - R^2) e^(-t).
// Five substeps of .1 have .9^5 for e^(-.5): a radius that is .003 or .05 h less. Crossings of
// chords are within h^2 / 8r, .02 h.
void TimeScaleIsMotionTimePerPipelineTime(Check& check)
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
  check.Near(radius, exact, 0.08 * 0.0625, "radius after .5 of motion time");
  check.Near(radius, GetSkinBounds(plain)[1], 1e-6, "as without a scale");
}

void ProgressRisesToOneAndCanBeStopped(Check& check)
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
  filter->SetCheckpointInterval(0); // the way is long every time
  filter->AddObserver(vtkCommand::ProgressEvent, watcher);
  filter->UpdateTimeStep(1.0);
  check.Equal(watch.Falls, 0, "falls of the progress");
  check.Equal(watch.Last, 1.0, "last progress");
  check.Less(20, watch.Calls, "calls");
  const std::string whole = GetBytes(filter);

  watch = Watch();
  watch.Stop = true;
  filter->SetAttraction(1.01);
  filter->SetAttraction(1.0);
  filter->UpdateTimeStep(0.0);
  filter->UpdateTimeStep(1.0);
  check.Equal(filter->GetOutput()->GetNumberOfPoints(), 0, "points when aborted");
  watch.Stop = false;
  filter->AbortExecuteOff();
  filter->UpdateTimeStep(1.0);
  check.True(GetBytes(filter) == whole, "the same bytes after an abort");
}

int main(int argc, char** argv)
{
  return RunFacts(argc, argv,
    { { "StepsOfItsOwnArePublished", StepsOfItsOwnArePublished },
      { "StepsOfTheInputArePassedOn", StepsOfTheInputArePassedOn },
      { "ContinuousInputIsAskedAtOwnSteps", ContinuousInputIsAskedAtOwnSteps },
      { "WithoutATimeItIsTheFirstStep", WithoutATimeItIsTheFirstStep },
      { "EachInputStepIsAskedForOnce", EachInputStepIsAskedForOnce },
      { "ForwardRequestsContinue", ForwardRequestsContinue },
      { "SameTimeAgainCostsNothing", SameTimeAgainCostsNothing },
      { "EarlierTimeRestarts", EarlierTimeRestarts },
      { "OrderOfRequestsDoesNotMatter", OrderOfRequestsDoesNotMatter },
      { "TimesBetweenLeaveTheTrajectoryAlone", TimesBetweenLeaveTheTrajectoryAlone },
      { "TimesThatDifferByRoundingAreTheStep", TimesThatDifferByRoundingAreTheStep },
      { "TimesBeyondTheStepsAreTheFirstAndTheLast", TimesBeyondTheStepsAreTheFirstAndTheLast },
      { "TimeScaleIsMotionTimePerPipelineTime", TimeScaleIsMotionTimePerPipelineTime },
      { "ProgressRisesToOneAndCanBeStopped", ProgressRisesToOneAndCanBeStopped } });
}
