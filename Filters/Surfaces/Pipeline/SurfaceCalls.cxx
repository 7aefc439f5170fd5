// Calls of a surface other than VTK's pipeline requests.

#include "NarrowBand.h"
#include "Pipeline/SurfaceRequests.h"

#include "vtkDataObject.h"

namespace activesurface
{

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
  if (!this->Simulation.HasBegun()) // if the first frame was rejected
  {
    this->Pushed.Stop();
  }
  if (data && this->Target.IsConnected() && !this->Pushed.AreConnected())
  {
    this->Target.Check(data); // rejected data must not replace another input
  }
  this->Pushed.Push(properties, data, dt);
}

void SurfaceRequests::Restart()
{
  this->Update.Refuse("ResetTrajectory");
  this->Simulation.Reset();
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
  RunTogether(this->Ranks, write);
}

void SurfaceRequests::LoadState(const std::string& file)
{
  this->Update.Refuse("LoadState");
  SavedState state;
  RunTogether(this->Ranks, [&] { state = ReadState(file); });
  this->Simulation.SetState(state);
}

}
