#include "Pipeline/InputClock.h"

#include "Pipeline/Compatibility.h"
#include "Pipeline/SurfaceInput.h"

#include <algorithm>

namespace activesurface
{

namespace
{

std::vector<double> MakeOwnSteps(const ClockProperties& properties, int count)
{
  std::vector<double> steps;
  steps.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i)
  {
    steps.push_back(properties.StartTime + i * properties.TimeStepSize);
  }
  return steps;
}

// Removes repeated times: vtkForceTime publishes its fixed time once for each step of its input.
std::vector<double> MergeEqualNeighbours(std::vector<double> steps)
{
  steps.erase(std::unique(steps.begin(), steps.end()), steps.end());
  return steps;
}

}

void InputClock::Read(const ClockProperties& properties, bool isEquilibrium, vtkInformation* target)
{
  if (this->IsPushed)
  {
    *this = InputClock();
  }
  this->OnlyForward = !isEquilibrium && target && GetPriorAccess(target) != PriorAccess::Free;
  this->InputSteps = MergeEqualNeighbours(SurfaceInput::GetTimeSteps(target));
  this->Published = this->InputSteps;
  if (this->OnlyForward)
  {
    this->TargetMoves = true;
    this->Steps = this->Requested;
    return;
  }
  this->Requested.clear();
  const bool hasSteps = this->InputSteps.size() > 1;
  this->TargetMoves = !isEquilibrium && (hasSteps || SurfaceInput::IsContinuous(target));
  this->Steps = hasSteps
    ? this->InputSteps
    : MakeOwnSteps(properties, isEquilibrium ? 1 : properties.NumberOfTimeSteps);
  if (isEquilibrium)
  {
    this->Steps.resize(std::min(this->Steps.size(), std::size_t(1)));
  }
  this->Published = this->Steps;
}

void InputClock::Read(const std::vector<double>& pushed)
{
  *this = InputClock();
  this->IsPushed = this->OnlyForward = this->TargetMoves = true;
  this->Requested = this->Steps = pushed;
}

bool InputClock::Request(vtkInformation* target, double time)
{
  if (!this->OnlyForward || this->IsPushed)
  {
    return false;
  }
  const bool startsAnew = GetPriorAccess(target) == PriorAccess::Reset;
  if (startsAnew)
  {
    this->Requested.clear();
  }
  if (this->Requested.empty() || time > this->Requested.back())
  {
    this->Requested.push_back(time);
  }
  this->Steps = this->Requested;
  return startsAnew;
}

void InputClock::WriteTo(SurfaceInputs& inputs) const
{
  inputs.TargetMoves = this->TargetMoves;
  inputs.OnlyForward = this->OnlyForward;
  inputs.Steps = this->Steps;
  inputs.InputSteps = this->OnlyForward ? this->Requested : this->InputSteps;
}

}
