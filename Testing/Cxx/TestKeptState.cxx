// What is kept when a motion does not get to its end: all substeps that were finished; and that
// going on from there gives what an undisturbed motion gives, to the byte.

#include "Check.h"
#include "PipelineTools.h"

#include "vtkAlgorithm.h"
#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkExecutive.h"
#include "vtkPolyData.h"
#include "vtkSphere.h"

using namespace activesurface;

namespace
{

constexpr int Few = 10000; // a ball of radius .6 has 7200 active voxels, one of .9 16000
constexpr int Many = 60000;

// A ball of radius .6 that becomes one of .9, in steps of 1 with about 9 substeps in the first.
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

// An update that comes to an error with these words, and leaves no output.
void Fails(Check& check, vtkActiveImplicitSurface* filter, double time, const std::string& words)
{
  Messages messages(filter);
  filter->UpdateTimeStep(time);
  check.Equal(Messages::Count(messages.Errors, words), 1, "errors with \"" + words + "\"");
  check.Equal(filter->GetOutput()->GetNumberOfPoints(), 0, "points");
  filter->RemoveAllObservers();
  filter->GetExecutive()->RemoveAllObservers();
}

// One that has failed between the steps 0 and 1.
vtkSmartPointer<vtkActiveImplicitSurface> MakeInterrupted(Check& check)
{
  auto filter = MakeGrowingBall(Few);
  Fails(check, filter, 2.0, "MaximumNumberOfActiveVoxels");
  filter->SetMaximumNumberOfActiveVoxels(Many);
  return filter;
}

// Stops after so many substeps.
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

void RaisingTheMaximumGoesOn(Check& check)
{
  auto direct = MakeGrowingBall(Many);
  const std::string bytes = GetBytesAt(direct, 2.0);
  auto filter = MakeGrowingBall(Few);
  Fails(check, filter, 2.0, "MaximumNumberOfActiveVoxels");
  const auto before = filter->GetSubsteps();
  check.Less(0, before, "substeps before the error");
  check.Less(before, direct->GetSubsteps(), "substeps before the error");
  filter->SetMaximumNumberOfActiveVoxels(Many);
  check.True(GetBytesAt(filter, 2.0) == bytes, "the same bytes as without an error");
  check.Equal(filter->GetSubsteps(), direct->GetSubsteps(), "substeps in all");
}

// The guard comes after a substep, so that each update gains one until it is done.
void ErrorsOneAfterTheOtherGainASubstepEach(Check& check)
{
  auto direct = MakeGrowingBall(Many);
  const std::string bytes = GetBytesAt(direct, 1.0);
  auto filter = MakeGrowingBall(Few);
  Fails(check, filter, 1.0, "MaximumNumberOfActiveVoxels");
  const auto once = filter->GetSubsteps();
  Fails(check, filter, 1.0, "MaximumNumberOfActiveVoxels");
  check.Equal(filter->GetSubsteps(), once + 1, "substeps after the second error");
  filter->SetMaximumNumberOfActiveVoxels(Many);
  check.True(GetBytesAt(filter, 1.0) == bytes, "the same bytes as without an error");
  check.Equal(filter->GetSubsteps(), direct->GetSubsteps(), "substeps in all");
}

void StoppedMotionGoesOn(Check& check)
{
  auto direct = MakeGrowingBall(Many);
  const std::string bytes = GetBytesAt(direct, 2.0);
  auto filter = MakeGrowingBall(Many);
  filter->Update();
  Stopper stopper = { 5 };
  stopper.Watch(filter);
  filter->UpdateTimeStep(2.0);
  check.Equal(filter->GetOutput()->GetNumberOfPoints(), 0, "points when stopped");
  const auto before = filter->GetSubsteps();
  check.Less(0, before, "substeps before it");
  stopper.Left = 1000;
  filter->AbortExecuteOff();
  check.True(GetBytesAt(filter, 2.0) == bytes, "the same bytes as without a stop");
  check.Equal(filter->GetSubsteps(), direct->GetSubsteps(), "substeps in all");
}

void StoppedStartIsMadeAgain(Check& check)
{
  auto filter = MakeGrowingBall(Many);
  Stopper stopper = { 5 };
  stopper.Watch(filter);
  filter->UpdateTimeStep(1.0);
  check.Equal(filter->GetOutput()->GetNumberOfPoints(), 0, "points when stopped");
  check.Equal(filter->GetSubsteps(), 0, "substeps");
  stopper.Left = 1000;
  filter->AbortExecuteOff();
  check.True(GetBytesAt(filter, 1.0) == GetBytesAt(MakeGrowingBall(Many), 1.0), "the same bytes");
}

// What is between two steps is no state to branch off, nor the step before it.
void TimesBeforeTheNextStepStartAnew(Check& check)
{
  auto direct = MakeGrowingBall(Many);
  for (const double time : { 0.0, 0.01, 0.9 })
  {
    auto filter = MakeInterrupted(check);
    const std::string name = std::to_string(time);
    check.True(GetBytesAt(filter, time) == GetBytesAt(direct, time), "the same bytes at " + name);
    check.True(GetBytesAt(filter, 1.0) == GetBytesAt(direct, 1.0), "and then at 1");
  }
}

void InterruptedBranchLeavesTheStepAlone(Check& check)
{
  auto direct = MakeGrowingBall(Many);
  const std::string between = GetBytesAt(direct, 0.9);
  const auto substeps = direct->GetSubsteps();
  const std::string atOne = GetBytesAt(direct, 1.0);
  auto filter = MakeGrowingBall(Few);
  const std::string start = GetBytesAt(filter, 0.0);
  Fails(check, filter, 0.9, "MaximumNumberOfActiveVoxels");
  filter->SetMaximumNumberOfActiveVoxels(Many);
  check.True(GetBytesAt(filter, 0.9) == between, "the same bytes between the steps");
  check.Equal(filter->GetSubsteps(), substeps, "substeps of the branch");
  check.True(GetBytesAt(filter, 0.0) == start, "the same bytes at the step");
  check.Equal(filter->GetSubsteps(), substeps, "which was kept");
  check.True(GetBytesAt(filter, 1.0) == atOne, "the same bytes at the next step");
}

// The source fails at its fourth execution, without being modified. Step 2 is asked for once more
// as VTK takes a time that has failed for made.
void InputThatFailsKeepsTheLastStep(Check& check)
{
  auto source = MakeMovingBall();
  auto filter = MakeSkinOver(source);
  source->SetFailingExecution(3);
  Fails(check, filter, 4.0, "input has failed to make its time step 3");
  check.Equal(source->GetExecutions(), "0 1 2 3 ", "times asked for");
  source->SetFailingExecution(-1);
  const std::string bytes = GetBytesAt(filter, 4.0);
  check.Equal(source->GetExecutions(), "0 1 2 3 2 3 4 ", "times asked for in all");
  auto direct = MakeSkinOver(MakeMovingBall());
  check.True(bytes == GetBytesAt(direct, 4.0), "the same bytes as without an error");
  check.Equal(filter->GetSubsteps(), direct->GetSubsteps(), "substeps in all");
}

// The same, where the step that fails is the one that the pipeline asks for.
void NextStepThatFailsKeepsTheOneBefore(Check& check)
{
  auto source = MakeMovingBall();
  auto filter = MakeSkinOver(source);
  filter->UpdateTimeStep(2.0);
  source->SetFailingExecution(3);
  Messages messages(filter);
  filter->UpdateTimeStep(3.0);
  check.Equal(source->GetExecutions(), "0 1 2 3 ", "times asked for");
  source->SetFailingExecution(-1);
  const std::string bytes = GetBytesAt(filter, 3.0);
  check.Equal(source->GetExecutions(), "0 1 2 3 2 3 ", "times asked for in all");
  auto direct = MakeSkinOver(MakeMovingBall());
  check.True(bytes == GetBytesAt(direct, 3.0), "the same bytes as without an error");
  check.Equal(filter->GetSubsteps(), direct->GetSubsteps(), "substeps in all");
}

void ChangedPropertyStartsAnewAfterAnError(Check& check)
{
  auto filter = MakeInterrupted(check);
  auto direct = MakeGrowingBall(Many);
  filter->SetAttraction(1.5);
  direct->SetAttraction(1.5);
  check.True(GetBytesAt(filter, 1.0) == GetBytesAt(direct, 1.0), "the same bytes");
}

int main(int argc, char** argv)
{
  return RunFacts(argc, argv,
    { { "RaisingTheMaximumGoesOn", RaisingTheMaximumGoesOn },
      { "ErrorsOneAfterTheOtherGainASubstepEach", ErrorsOneAfterTheOtherGainASubstepEach },
      { "StoppedMotionGoesOn", StoppedMotionGoesOn },
      { "StoppedStartIsMadeAgain", StoppedStartIsMadeAgain },
      { "TimesBeforeTheNextStepStartAnew", TimesBeforeTheNextStepStartAnew },
      { "InterruptedBranchLeavesTheStepAlone", InterruptedBranchLeavesTheStepAlone },
      { "InputThatFailsKeepsTheLastStep", InputThatFailsKeepsTheLastStep },
      { "NextStepThatFailsKeepsTheOneBefore", NextStepThatFailsKeepsTheOneBefore },
      { "ChangedPropertyStartsAnewAfterAnError", ChangedPropertyStartsAnewAfterAnError } });
}
