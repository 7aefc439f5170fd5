// What a SurfaceSimulation tells of its surface, and takes up again.

#include "SurfaceSimulation.h"

#include "SkinMotion.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace activesurface
{

SavedState SurfaceSimulation::GetState() const
{
  SavedState state;
  if (this->Step >= 0 && !this->IsUnderWay())
  {
    state.Band = this->Band;
    state.Time = this->Settings.Steps[this->Step];
    state.History = this->History;
    state.History.resize(std::min(this->History.size(), std::size_t(this->Step) + 1));
  }
  return state;
}

void SurfaceSimulation::SetState(const SavedState& state)
{
  this->Drop();
  this->Loaded = state;
  this->LoadedIsNew = true;
}

// When the target is at its start, as always: the voxels and the radius of the particles come from
// there.
void SurfaceSimulation::TakeLoaded()
{
  const std::vector<double>& steps = this->Settings.Steps;
  const GoalTime time = FindGoal(steps, this->Loaded.Time);
  const NarrowBand& band = *this->Loaded.Band;
  const double motionTime = this->Settings.GetMotionTime(time.Time);
  if (time.Between || std::fabs(band.GetTime() - motionTime) > 1e-9 * std::fabs(motionTime) ||
    band.GetVoxelSize() != this->FindDomain()->VoxelSize)
  {
    throw std::invalid_argument(
      "The state that was loaded is not one of this surface: its time is no "
      "time step, or its VoxelSize another one. The properties have to be "
      "those that it was saved with.");
  }
  this->Saved.Keep(time.Step, band);
  // Each checkpoint has its rows: what is known of later steps stays.
  if (this->History.size() < this->Loaded.History.size())
  {
    this->History = this->Loaded.History;
  }
}

std::vector<float> SurfaceSimulation::GetSpeeds()
{
  const NarrowBand& band = this->GetBand();
  if (band.IsEmpty())
  {
    return {};
  }
  this->PlaceTargetFrom(this->Goal.Step);
  const Motion motion = this->GetMotion();
  return FindSpeeds(
    band, { motion, this->Shapes.GetTarget(), band.GetStartArea(), band.GetStartVolume() });
}

// Whether the particles' way is wanted, from which their velocities follow.
bool SurfaceSimulation::WantsWay() const
{
  return this->Wishes.Drift ||
    (this->Wishes.Bound && this->Shapes.GetKind() == TargetKind::Particles);
}

// Whether it is the way to the goal, from the step before.
bool SurfaceSimulation::LooksBack(bool wantsWay) const
{
  const int before = this->Goal.Step - 1;
  return wantsWay && this->Settings.InputMoves && !this->Goal.Between && before >= 0 &&
    (!this->Settings.OnlyForward || this->Shapes.HasExtras(before, this->Wishes.Extras));
}

// Frames that tell what is wished at the goal: after a return to a checkpoint they may not be
// there.
int SurfaceSimulation::GetStepWantedAtGoal() const
{
  const SkinWishes& wishes = this->Wishes;
  const bool wantsParticles = wishes.Arrays || wishes.Drift;
  const int last = static_cast<int>(this->Settings.Steps.size()) - 1;
  const bool looksAhead = this->Goal.Between || (this->WantsWay() && this->Goal.Step == 0);
  int from = this->Goal.Step - (this->LooksBack(this->WantsWay()) ? 1 : 0);
  int to = std::min(this->Goal.Step + (looksAhead ? 1 : 0), last);
  if (!this->Settings.InputMoves)
  {
    from = to = 0;
  }
  for (int step = from; step <= to && (wishes.Speeds || wantsParticles); ++step)
  {
    if (!this->Shapes.Has(step) || (wantsParticles && !this->Shapes.HasExtras(step, wishes.Extras)))
    {
      return step;
    }
  }
  return -1;
}

double SurfaceSimulation::GetFastestParticle()
{
  const int first = this->Goal.Step - (this->LooksBack(this->WantsWay()) ? 1 : 0);
  TargetFrames& frames = this->Shapes.GetFrames();
  const bool moves = this->Settings.InputMoves && this->Shapes.GetKind() == TargetKind::Particles;
  const ParticleMatches* matches = moves ? frames.FindMatches(first) : nullptr;
  if (!matches)
  {
    return 0.0;
  }
  const double* steps = this->Settings.Steps.data() + first;
  const double duration = this->Settings.TimeScale * (steps[1] - steps[0]);
  return FindLongestWay(frames.Get(first).Particles, frames.Get(first + 1).Particles, *matches) /
    duration;
}

PassedArrays SurfaceSimulation::GetPassedArrays()
{
  PassedArrays passed;
  const bool isWished = this->Wishes.Arrays || this->Wishes.Drift;
  if (isWished && this->Shapes.GetKind() != TargetKind::Particles)
  {
    this->Messages.Say("no particles",
      "PassTargetArrays and TangentialVelocity do nothing here: the target has no particles.");
  }
  else if (isWished)
  {
    const bool looksBack = this->LooksBack(this->Wishes.Drift);
    const int first = this->Settings.InputMoves ? this->Goal.Step - (looksBack ? 1 : 0) : 0;
    const int second = std::min(first + 1, static_cast<int>(this->Settings.Steps.size()) - 1);
    const double begin = this->Settings.GetMotionTime(this->Settings.Steps[first]);
    const double duration = this->Settings.GetMotionTime(this->Settings.Steps[second]) - begin;
    const double goal = this->Settings.GetMotionTime(this->Goal.Time);
    const double fraction = looksBack                   ? 1.0
      : this->Goal.Between && this->Settings.InputMoves ? (goal - begin) / duration
                                                        : 0.0;
    passed.Moment = FindMoment(this->Shapes.GetFrames(), first, fraction);
    passed.Kernel = this->Settings.Particles.Kernel;
    passed.Arrays = this->Wishes.Arrays;
    if (this->Wishes.Drift)
    {
      passed.Velocities = passed.Moment.FindVelocities(duration);
    }
  }
  return passed;
}

std::shared_ptr<const NarrowBand> SurfaceSimulation::ShareBand() const
{
  return this->Goal.Between ? this->Branch : this->Band;
}

const NarrowBand* SurfaceSimulation::FindSkin() const
{
  const bool isAtGoal = this->Step >= 0 && this->Step == this->Goal.Step && !this->IsUnderWay() &&
    (!this->Goal.Between || this->BranchIsAtGoal()) && (!this->Settings.Settles || this->Settled);
  return isAtGoal ? &this->GetBand() : nullptr;
}

void SurfaceSimulation::AddToHistory(double pipelineTime, const std::string& event)
{
  const std::size_t row = this->Settled ? 1 : static_cast<std::size_t>(this->Step);
  this->History.resize(std::max(this->History.size(), row + 1));
  this->History[row] = this->Historian.MakeRow(*this->Band, pipelineTime);
  this->History[row].Event = event.empty() ? this->History[row].Event : event;
  this->Band->ForgetWork();
  this->Saved.Add(this->Step, *this->Band);
}

std::vector<HistoryRow> SurfaceSimulation::GetHistory() const
{
  const std::size_t rows =
    this->Settings.Settles ? 2 : static_cast<std::size_t>(this->Goal.Step) + 1;
  const auto end = this->History.begin() + std::min(rows, this->History.size());
  return std::vector<HistoryRow>(this->History.begin(), end);
}

}
