#include "InputClock.h"

#include "Compatibility.h"
#include "SurfaceInput.h"
#include "vtkActiveImplicitSurface.h"

#include <algorithm>

namespace activesurface
{

namespace
{

std::vector<double> MakeOwnSteps(vtkActiveImplicitSurface* filter, int count)
{
  std::vector<double> steps;
  for (int i = 0; i < count; ++i)
  {
    steps.push_back(filter->GetStartTime() + i * filter->GetTimeStepSize());
  }
  return steps;
}

// vtkForceTime lists the time that it holds on to as often as its own input has steps.
std::vector<double> MergeEqualNeighbours(std::vector<double> steps)
{
  steps.erase(std::unique(steps.begin(), steps.end()), steps.end());
  return steps;
}

}

void InputClock::Read(vtkActiveImplicitSurface* filter, vtkInformation* target)
{
  const bool settles = filter->GetEvolutionMode() == vtkActiveMotionAlgorithm::EQUILIBRIUM;
  this->OnlyForward = !settles && target && GetPriorAccess(target) != PriorAccess::Free;
  this->InputSteps = MergeEqualNeighbours(SurfaceInput::GetTimeSteps(target));
  this->Published = this->InputSteps;
  if (this->OnlyForward)
  {
    this->InputMoves = true;
    this->Steps = this->Asked;
    return;
  }
  this->Asked.clear();
  const bool hasSteps = this->InputSteps.size() > 1;
  this->InputMoves = !settles && (hasSteps || SurfaceInput::IsContinuous(target));
  this->Steps = hasSteps ? this->InputSteps
                         : MakeOwnSteps(filter, settles ? 1 : filter->GetNumberOfTimeSteps());
  if (settles)
  {
    this->Steps.resize(std::min(this->Steps.size(), std::size_t(1)));
  }
  this->Published = this->Steps;
}

bool InputClock::Ask(vtkInformation* target, double time)
{
  if (!this->OnlyForward)
  {
    return false;
  }
  const bool startsAnew = GetPriorAccess(target) == PriorAccess::Reset;
  if (startsAnew)
  {
    this->Asked.clear();
  }
  if (this->Asked.empty() || time > this->Asked.back())
  {
    this->Asked.push_back(time);
  }
  this->Steps = this->Asked;
  return startsAnew;
}

void InputClock::WriteTo(SurfaceSettings& settings) const
{
  settings.InputMoves = this->InputMoves;
  settings.OnlyForward = this->OnlyForward;
  settings.Steps = this->Steps;
  settings.InputSteps = this->OnlyForward ? this->Asked : this->InputSteps;
}

}
