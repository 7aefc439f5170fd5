// Saves and restores the state of a simulation; returns its history.

#include "Simulation/SurfaceSimulation.h"

#include <cmath>
#include <stdexcept>

namespace activesurface
{

SavedState SurfaceSimulation::GetState() const
{
  SavedState state;
  if (this->Path.HasBegun() && !this->Path.IsUnfinished() && !this->Settings.IsEquilibrium())
  {
    const int step = this->Path.GetStep();
    state.Band = this->Path.Share({ step, this->Settings.GetStep(step), false });
    state.Origin = this->GetOrigin();
    state.Time = this->Settings.GetStep(step).Value;
    state.History = this->History.GetRows(static_cast<std::size_t>(step) + 1);
    state.Spacing = this->Shapes.GetEstimatedSpacing();
  }
  return state;
}

SavedState SurfaceSimulation::GatherState() const
{
  SavedState state = this->GetState();
  if (state.Band && state.Band->GetPart())
  {
    state.Band = state.Band->GatherWhole(false);
  }
  return state;
}

void SurfaceSimulation::SetState(const SavedState& state)
{
  this->Reset();
  this->Loaded = state;
  this->LoadedIsNew = true;
}

// Requires StartTarget, which prepares the first frame for the voxel size of the domain.
void SurfaceSimulation::RestoreLoaded()
{
  const RequestedTime time = this->Settings.FindRequested({ this->Loaded.Time });
  const NarrowBand& band = *this->Loaded.Band;
  const double motionTime = this->Settings.ToMotionTime(time.Time).Value;
  // A vanished skin keeps the time at which it vanished.
  const bool isOfAnotherTime =
    !band.IsEmpty() && std::fabs(band.GetTime() - motionTime) > 1e-9 * std::fabs(motionTime);
  const bool isOfAnotherLattice = band.GetVoxelSize() != this->FindDomain()->VoxelSize ||
    this->Loaded.Origin != this->GetOrigin();
  if (time.Between || isOfAnotherTime || isOfAnotherLattice)
  {
    throw std::invalid_argument(
      "The loaded state does not fit this surface: its time is not a time step, or its VoxelSize "
      "or the position of its data differs. Set the properties with which the state was saved.");
  }
  this->Shapes.KeepEstimatedSpacing(this->Loaded.Spacing);
  this->Saved.Keep(time.Step, band);
  // Restores the rows up to this step, unless more rows are recorded already.
  this->History.Restore(this->Loaded.History);
}

Motion SurfaceSimulation::GetMotion() const
{
  const ArrayFrames frames = this->FindArrayFrames();
  return this->Driver.GetMotion(
    this->Path.GetStep(), this->Shapes.HasParticles(frames.First, frames.Last));
}

std::vector<HistoryRow> SurfaceSimulation::GetHistory() const
{
  return this->History.GetRows(
    this->Settings.IsEquilibrium() ? 2 : static_cast<std::size_t>(this->Requested.Step) + 1);
}

}
