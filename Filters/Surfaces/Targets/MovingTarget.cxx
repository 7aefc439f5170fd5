#include "Targets/MovingTarget.h"

#include <algorithm>

namespace activesurface
{

void MovingTarget::MoveAlong(int step, double begin, double end)
{
  this->Begin = begin;
  this->End = end;
  this->HasJumped = this->PlaceOnce(step, 0.0) || this->HasJumped;
}

void MovingTarget::MoveTo(double time)
{
  this->MoveVelocitiesTo(time);
  this->Complete();
}

void MovingTarget::Complete()
{
  if (!this->IsFinished)
  {
    this->Finish();
    this->IsFinished = true;
  }
}

void MovingTarget::MoveVelocitiesTo(double time)
{
  const double length = this->End - this->Begin;
  const double fraction = length > 0.0 ? (time - this->Begin) / length : 0.0;
  const bool placed = this->PlaceOnce(this->Step, std::min(std::max(fraction, 0.0), 1.0));
  this->Recent = this->HasJumped ? Change::Everything
    : placed                     ? Change::LastPlace
                                 : Change::Nothing;
  this->HasJumped = false;
}

bool MovingTarget::MayHaveChanged(const double bounds[6]) const
{
  return this->Recent == Change::Everything ||
    (this->Recent == Change::LastPlace && this->HasChangedIn(bounds));
}

bool MovingTarget::HasChangedIn(const double[6]) const
{
  return true;
}

bool MovingTarget::PlaceOnce(int step, double fraction)
{
  const bool hasSameWay = !this->DependsOnDuration() || this->PlacedDuration == this->GetDuration();
  if (step == this->Step && fraction == this->Fraction && hasSameWay)
  {
    return false;
  }
  this->PlacedDuration = this->GetDuration();
  this->Step = step;
  this->Fraction = fraction;
  this->IsFinished = false;
  this->Place(step, fraction);
  return true;
}

}
