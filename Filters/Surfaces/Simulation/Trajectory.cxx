#include "Simulation/Trajectory.h"

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

bool Trajectory::IsUnderWay() const
{
  if (!this->HasBegun() || this->Settings.IsEquilibrium())
  {
    return false;
  }
  // A substep may fail after it has created parts: time is unchanged then, the band is not.
  return this->Band->GetTime() > this->Settings.GetMotionTimeOf(this->Step).Value ||
    this->Band->GetWork().CreatedParts > 0;
}

bool Trajectory::BranchIsAt(PipelineTime time) const
{
  return this->Branch && this->BranchTime == time && !this->BranchIsUnderWay;
}

bool Trajectory::IsAt(const RequestedTime& time) const
{
  return this->HasBegun() && this->Step == time.Step && !this->IsUnderWay() &&
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
    this->BranchIsUnderWay = true;
  }
  return *this->Branch;
}

std::shared_ptr<const NarrowBand> Trajectory::Share(const RequestedTime& time) const
{
  return time.Between ? this->Branch : this->Band;
}

}
