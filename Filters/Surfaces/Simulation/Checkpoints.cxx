#include "Simulation/Checkpoints.h"

#include "BandPart.h"
#include "NarrowBand.h"

#include <iterator>
#include <limits>

namespace activesurface
{

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

// The size of a part is its mean over the ranks, so that all ranks remove the same states.
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

// Removes the first state last: without it an earlier time restarts the motion. Of the others,
// removes the one that leaves the smallest gap.
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
