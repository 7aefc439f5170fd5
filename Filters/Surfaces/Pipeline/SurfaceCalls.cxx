// Calls of the filter other than VTK's pipeline requests, and the check of the filter's inputs.

#include "NarrowBand.h"
#include "Pipeline/RankedRequest.h"
#include "Pipeline/SurfaceRequests.h"

#include "vtkDataObject.h"

#include <stdexcept>

namespace activesurface
{

namespace
{

constexpr const char* NoMemoryForState = "There is not enough memory to save or load the state; "
                                         "free memory, or save and load on a larger machine.";

}

vtkGridPotential* SurfaceRequests::GetSkinFunction()
{
  const NarrowBand* skin = this->Simulation.FindSkin();
  if (skin && skin->GetPart())
  {
    this->Simulation.Warn("function of a part",
      "GetSkinFunction covers only this rank's part of space and 8 voxels around this part. Turn "
      "OutputPotential on for a function of the whole skin on each rank.");
  }
  return this->Outputs.GetSkinFunction(this->Simulation);
}

void SurfaceRequests::Push(const SurfaceProperties& properties, vtkDataObject* data, double dt)
{
  this->Update.Refuse("Advance");
  if (data && this->Target.IsConnected() && !this->Pushed.AreConnected())
  {
    this->Target.Check(data); // rejected data must not replace another input
  }
  this->Pushed.Push(properties, data, dt, this->Simulation.ListTimesToResume());
}

void SurfaceRequests::Restart()
{
  this->Update.Refuse("ResetTrajectory");
  this->Simulation.StartAnew();
  this->Pushed.Stop();
}

bool SurfaceRequests::WithdrawFrame()
{
  if (!this->Simulation.WithdrawLastStep())
  {
    return false;
  }
  this->Pushed.Withdraw();
  this->Simulation.SetTargetMTime(this->Target.GetPipelineMTime());
  return true;
}

void SurfaceRequests::SaveState(const std::string& file)
{
  const auto write = [&]
  {
    const SavedState state = this->Simulation.GatherState();
    if (this->Ranks.GetRank() == 0)
    {
      WriteState(file, state);
    }
  };
  RunTogether(this->Ranks,
    [&]
    {
      RunWithinMemory(
        write, [] {}, NoMemoryForState);
    });
}

void SurfaceRequests::LoadState(const std::string& file)
{
  this->Update.Refuse("LoadState");
  SavedState state;
  const auto read = [&] { state = ReadState(file); };
  RunTogether(this->Ranks,
    [&]
    {
      RunWithinMemory(
        read, [] {}, NoMemoryForState);
    });
  this->Simulation.SetState(state);
  this->Clock.Resume(this->Simulation.ListTimesToResume());
}

// Throws std::invalid_argument if a target is missing, or if there are two targets or two initial
// shapes. Throws RankError for data sets of levels (AMR): VTK calls a rank once for each of the
// rank's blocks, so the ranks have no common collective call. Data have levels on all ranks or on
// none, so all ranks throw.
void SurfaceRequests::CheckInputs() const
{
  const SurfaceInputs& inputs = this->Simulation.GetSettings().Inputs;
  const bool isFunction = inputs.TargetFunction != nullptr;
  if (isFunction && this->Target.IsConnected())
  {
    throw std::invalid_argument("There are two targets, TargetFunction and the input of port 0; "
                                "set TargetFunction to none or disconnect the input.");
  }
  if (!isFunction && !this->Target.IsConnected())
  {
    throw std::invalid_argument(
      "There is no target; set TargetFunction, or connect particles, a skeleton of lines, a closed "
      "mesh or an image to input port 0.");
  }
  if (inputs.InitialFunction && this->Initial.IsConnected())
  {
    throw std::invalid_argument("There are two initial shapes, InitialFunction and the input of "
                                "port 1; set InitialFunction to none or disconnect the input.");
  }
  if (this->Target.IsStillAt(this->CompositeTarget))
  {
    throw RankError("The input is a composite data set of levels (AMR), which cannot be a "
                    "target; make one image of it (vtkResampleToImage).");
  }
  if (this->Initial.IsStillAt(this->CompositeInitial))
  {
    throw RankError(
      "The input of port 1 is a composite data set of levels (AMR), which is no initial "
      "shape; make one image of it (vtkResampleToImage).");
  }
}

}
