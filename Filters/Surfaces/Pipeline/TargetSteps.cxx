#include "Pipeline/TargetSteps.h"

#include "vtkInformation.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace activesurface
{

namespace
{

std::string Format(double time)
{
  std::ostringstream text;
  text << time;
  return text.str();
}

}

// Returns a step other than `missing`, if possible. VTK regards a failed request for a time as
// fulfilled, so the algorithm executes again only after a request for another time. The step that
// was read last is the cheapest.
int TargetSteps::FindStepBeside(int missing) const
{
  const int made = this->Simulation.GetLastStepAdded();
  const SurfaceInputs& inputs = this->Simulation.GetSettings().Inputs;
  if (made != missing || inputs.OnlyForward)
  {
    return made;
  }
  const int last = static_cast<int>(inputs.Steps.size()) - 1;
  return missing < last ? missing + 1 : std::max(missing - 1, 0);
}

void TargetSteps::Request(vtkInformation* target)
{
  const SurfaceInputs& inputs = this->Simulation.GetSettings().Inputs;
  const int missing = this->Simulation.FindMissingStep();
  const bool isNewest = missing + 1 == static_cast<int>(inputs.Steps.size());
  const bool isReady = missing >= 0 && (inputs.OnlyForward ? isNewest : !this->LastUpdateFailed);
  const bool isStillAndFailed =
    this->LastUpdateFailed && !inputs.TargetMoves && inputs.InputSteps.size() > 1;
  this->Requested = isReady ? missing : this->FindStepBeside(missing);
  this->RequestedFirst = inputs.TargetMoves ? this->Requested == 0 : !isStillAndFailed;
  this->LastUpdateFailed = true;
  this->Target.RequestFirst(target);
  if (inputs.TargetMoves)
  {
    target->Set(
      vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP(), inputs.Steps[this->Requested]);
  }
  else if (isStillAndFailed)
  {
    target->Set(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP(), inputs.InputSteps[1]);
    this->Requested = NoStep;
  }
}

// The estimate omits later steps that fail: such a step is an error only when the surface reaches
// it. The first step is read a second time if ranks partition space.
void TargetSteps::SettleSpacing(vtkInformation* target, Agreement& ranks)
{
  const SurfaceSettings& settings = this->Simulation.GetSettings();
  std::shared_ptr<InputShape> first = this->Make(target, 0, true);
  if (!first->HasPoints() || first->GetParticles())
  {
    std::vector<TargetBuilder::SpacingSample> samples{ this->Simulation.SampleSpacing(*first) };
    for (const int step : this->Simulation.ListSpacingSteps())
    {
      if (ranks.GoOn(this->Target.Update(target, settings.GetStep(step).Value)))
      {
        samples.push_back(this->Simulation.SampleSpacing(*this->Read(target)));
      }
    }
    this->Simulation.SettleSpacing(samples);
  }
  const bool isReadAgain = this->Simulation.SharesSpace() && !ranks.IsAlone() && first->HasPoints();
  this->Simulation.AddFrame(0, isReadAgain ? this->Make(target, 0, true) : std::move(first));
}

void TargetSteps::AddFirst(vtkInformation* target)
{
  if (this->Simulation.FindMissingStep() == 0)
  {
    this->Simulation.AddFrame(0, this->Read(target));
  }
}

void TargetSteps::AddRequested(vtkInformation* target)
{
  this->LastUpdateFailed = false;
  if (target && this->Requested != NoStep && this->Simulation.FindMissingStep() == this->Requested)
  {
    this->Simulation.AddFrame(this->Requested, this->Read(target));
  }
}

std::shared_ptr<InputShape> TargetSteps::Make(vtkInformation* target, int step, bool mayGoBack)
{
  const double time = this->Simulation.GetSettings().GetStep(step).Value;
  if (!mayGoBack)
  {
    throw std::runtime_error("The time step " + Format(time) +
      " of the input is needed again, but the input provides each time step only once "
      "(NO_PRIOR_TEMPORAL_ACCESS). Request times in ascending order, and do not change a property "
      "that restarts the motion. To request earlier times, set CheckpointInterval to 1, raise "
      "CheckpointMemory, and turn ComputeVelocity and PassTargetArrays off.");
  }
  this->LastUpdateFailed = true;
  if (!this->Target.Update(target, time))
  {
    throw std::runtime_error("The update of the input failed at the time step " + Format(time) +
      "; see the error of the input.");
  }
  this->LastUpdateFailed = false;
  return this->Read(target);
}

std::shared_ptr<InputShape> TargetSteps::Read(vtkInformation* target) const
{
  return this->Target.Read(
    target, this->Simulation.GetRequestedArrays().Kept, this->Simulation.SharesSpace());
}

}
