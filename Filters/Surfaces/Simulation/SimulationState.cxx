// Saves and restores the state of a simulation; returns its history.

#include "Simulation/SurfaceSimulation.h"

#include <cmath>
#include <stdexcept>

namespace activesurface
{

SavedState SurfaceSimulation::MakeState(
  const std::shared_ptr<const NarrowBand>& band, PipelineTime time, std::size_t rows) const
{
  SavedState state;
  state.Band = band;
  state.Origin = this->GetOrigin();
  state.Time = time.Value;
  state.History = this->History.GetRows(rows);
  state.Spacing = this->Shapes.FindSpacing();
  if (const SurfaceDomain* domain = this->Shapes.GetDomain())
  {
    std::copy_n(domain->Bounds, 6, state.Bounds);
    state.Reach = domain->Reach;
  }
  return state;
}

SavedState SurfaceSimulation::GetState() const
{
  if (!this->Path.HasBegun() || this->Path.IsUnfinished() || this->Settings.IsEquilibrium())
  {
    return {};
  }
  const int step = this->Path.GetStep();
  const PipelineTime time = this->Settings.GetStep(step);
  return this->MakeState(
    this->Path.Share({ step, time, false }), time, static_cast<std::size_t>(step) + 1);
}

SavedState SurfaceSimulation::GetRequestedState() const
{
  return this->MakeState(this->ShareWholeBand(), this->Requested.Time, this->CountRows());
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

void SurfaceSimulation::StartAnew()
{
  this->Reset();
  this->Loaded = SavedState();
  this->LoadedIsNew = false;
}

std::vector<double> SurfaceSimulation::ListTimesToResume() const
{
  std::vector<double> times;
  if (this->Loaded.Band && !this->Path.HasBegun())
  {
    for (const HistoryRow& row : this->Loaded.History)
    {
      times.push_back(row.Time);
    }
  }
  return times;
}

// Returns the step of the first frame that the surface needs. A forward-only input has no earlier
// frame than that of a loaded state.
int SurfaceSimulation::FindFirstStep() const
{
  const SurfaceInputs& inputs = this->Settings.Inputs;
  return this->Loaded.Band && inputs.OnlyForward && !inputs.Steps.empty()
    ? this->Settings.FindRequested({ this->Loaded.Time }).Step
    : 0;
}

// Uses the domain of a loaded state if the first frame, from which the domain would follow, is
// unavailable.
void SurfaceSimulation::UseLoadedDomain()
{
  const SavedState& state = this->Loaded;
  if (state.Reach > 0.0 && this->FindFirstStep() > 0 && !this->Settings.HasBounds() &&
    !this->Shapes.GetDomain())
  {
    SurfaceDomain domain;
    domain.Origin = state.Origin;
    std::copy_n(state.Bounds, 6, domain.Bounds);
    domain.VoxelSize = state.Band->GetVoxelSize();
    domain.Reach = state.Reach;
    this->Shapes.SetDomain(domain, state.Spacing);
  }
}

// Call after StartTarget, which prepares the first frame with the domain's voxel size.
void SurfaceSimulation::RestoreLoaded()
{
  const RequestedTime time = this->Settings.FindRequested({ this->Loaded.Time });
  const NarrowBand& band = *this->Loaded.Band;
  const double motionTime = this->Settings.ToMotionTime(time.Time).Value;
  // A vanished skin without new parts keeps the time of the first step without skin.
  const bool isOfAnotherTime =
    !band.IsEmpty() && std::fabs(band.GetTime() - motionTime) > 1e-9 * std::fabs(motionTime);
  const double given = this->Settings.VoxelSize;
  const bool isOfAnotherLattice = band.GetVoxelSize() != this->FindDomain()->VoxelSize ||
    (given > 0.0 && band.GetVoxelSize() != given) || this->Loaded.Origin != this->GetOrigin();
  if (time.Between || isOfAnotherTime || isOfAnotherLattice)
  {
    throw std::invalid_argument(
      "The loaded state does not fit this surface: the first time, TimeScale, VoxelSize or the "
      "position of the data differs, or the state's time is not a time step. Set the properties "
      "and the input with which the state was saved.");
  }
  this->Shapes.KeepEstimatedSpacing(this->Loaded.Spacing);
  this->Saved.Keep(time.Step, band);
  // Restores the rows up to this step, unless as many or more rows are recorded already.
  this->History.Restore(this->Loaded.History);
}

Motion SurfaceSimulation::GetMotion() const
{
  const ArrayFrames frames = this->FindArrayFrames();
  return this->Driver.GetMotion(
    this->Path.GetStep(), this->Shapes.IsOnNodes(frames.First, frames.Last));
}

std::size_t SurfaceSimulation::CountRows() const
{
  return this->Settings.IsEquilibrium() ? 2 : static_cast<std::size_t>(this->Requested.Step) + 1;
}

std::vector<HistoryRow> SurfaceSimulation::GetHistory() const
{
  return this->History.GetRows(this->CountRows());
}

}
