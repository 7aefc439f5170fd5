#include "Simulation/Trajectory.h"

#include "BandPart.h"
#include "NarrowBand.h"

#include <iterator>
#include <limits>
#include <sstream>
#include <utility>

namespace activesurface
{

Trajectory::Trajectory(const SurfaceSettings& settings)
  : Settings(settings)
{
}

void Trajectory::Reset()
{
  this->Band.reset();
  this->Branch.reset();
  this->Step = -1;
  this->IsSteady = false;
}

void Trajectory::Begin(int step, std::unique_ptr<NarrowBand> band)
{
  this->Reset();
  this->Band = std::move(band);
  this->Step = step;
}

bool Trajectory::IsUnfinished() const
{
  if (!this->HasBegun() || this->Settings.IsEquilibrium())
  {
    return false;
  }
  // A substep may fail after creating parts: then the time is unchanged, but the band has changed.
  return this->Band->GetTime() > this->Settings.GetMotionTimeOf(this->Step).Value ||
    this->Band->GetWork().CreatedParts > 0;
}

bool Trajectory::BranchIsAt(PipelineTime time) const
{
  return this->Branch && this->BranchTime == time && !this->BranchIsUnfinished;
}

bool Trajectory::IsAt(const RequestedTime& time) const
{
  return this->HasBegun() && this->Step == time.Step && !this->IsUnfinished() &&
    (!time.Between || this->BranchIsAt(time.Time)) &&
    (!this->Settings.IsEquilibrium() || this->IsSteady);
}

std::string Trajectory::Describe() const
{
  std::ostringstream text;
  text << std::hexfloat << "step " << this->Step;
  if (this->HasBegun())
  {
    text << " at " << this->Band->GetTime() << ", " << this->Band->GetNumberOfActiveNodes()
         << " nodes" << (this->Branch ? ", branch" : "");
  }
  return text.str();
}

NarrowBand& Trajectory::GetBandToMove()
{
  this->Branch.reset();
  if (this->Band.use_count() > 1)
  {
    this->Band = this->Band->Clone();
  }
  return *this->Band;
}

NarrowBand& Trajectory::GetBranchTo(PipelineTime time)
{
  if (!this->Branch || this->BranchTime != time)
  {
    this->Branch = this->Band->Clone();
    this->BranchTime = time;
    this->BranchIsUnfinished = true;
  }
  return *this->Branch;
}

std::shared_ptr<const NarrowBand> Trajectory::Share(const RequestedTime& time) const
{
  return time.Between ? this->Branch : this->Band;
}

void Checkpoints::SetLimits(int interval, std::size_t memory)
{
  this->Interval = interval;
  this->Memory = memory;
  if (interval == 0)
  {
    this->Clear();
  }
  this->MakeRoom();
}

// The size of a part is estimated as the mean of all ranks, so that all ranks remove the same
// states.
Checkpoints::Saved Checkpoints::Save(const NarrowBand& band)
{
  constexpr std::size_t bytesPerNode = 6; // including the masks of its leaf
  Saved saved{ band.Pack(), band.SharePart(), 0 };
  const std::size_t ofAll = bytesPerNode * band.GetNumberOfActiveNodes();
  saved.Size = saved.Part ? ofAll / static_cast<std::size_t>(saved.Part->GetRanks().GetSize())
                          : saved.Bytes.size();
  return saved;
}

void Checkpoints::Add(int step, const NarrowBand& band)
{
  if (this->Interval > 0 && step % this->Interval == 0 && !this->States.count(step))
  {
    this->States[step] = Save(band);
    this->MakeRoom();
  }
}

void Checkpoints::Keep(int step, const NarrowBand& band)
{
  this->States[step] = Save(band);
}

int Checkpoints::FindUpTo(int step) const
{
  const auto after = this->States.upper_bound(step);
  return after == this->States.begin() ? -1 : std::prev(after)->first;
}

std::unique_ptr<NarrowBand> Checkpoints::Restore(int step) const
{
  const Saved& saved = this->States.at(step);
  return NarrowBand::Unpack(saved.Bytes, saved.Part);
}

std::size_t Checkpoints::GetSize() const
{
  std::size_t size = 0;
  for (const auto& [step, state] : this->States)
  {
    size += state.Size;
  }
  return size;
}

// While the capacity is exceeded, removes the state that leaves the smallest gap. Removes the first
// state last, because without it a request for a time before the second state restarts the motion.
void Checkpoints::MakeRoom()
{
  while (!this->States.empty() && this->GetSize() > this->Memory)
  {
    auto least = std::prev(this->States.end());
    int smallest = std::numeric_limits<int>::max();
    for (auto state = std::next(this->States.begin()); state != this->States.end(); ++state)
    {
      const auto next = std::next(state);
      const int after = next == this->States.end() ? state->first + this->Interval : next->first;
      const int gap = after - std::prev(state)->first;
      if (gap < smallest)
      {
        smallest = gap;
        least = state;
      }
    }
    this->States.erase(least);
  }
}

}
