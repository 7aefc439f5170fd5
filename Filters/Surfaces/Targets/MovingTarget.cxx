#include "Targets/MovingTarget.h"

#include <algorithm>

namespace activesurface
{

void MovingTarget::MoveAlong(int step, double begin, double end)
{
  this->FirstStep = step;
  this->Begin = begin;
  this->End = end;
  if (!this->IsAt(step, 0.0))
  {
    this->Step = -1;
    this->HasJumped = true;
    this->ForgetPlace();
  }
}

void MovingTarget::MoveTo(double time)
{
  const bool placed = this->PlaceOnce(this->FindFraction(time));
  this->HasChanged = this->HasJumped || placed;
  this->HasJumped = false;
  this->Complete();
}

void MovingTarget::Complete()
{
  if (!this->IsPlaced)
  {
    this->PlaceOnce(this->Step == this->FirstStep ? this->Fraction : 0.0);
  }
  if (!this->IsFinished)
  {
    this->Finish();
    this->IsFinished = true;
  }
}

double MovingTarget::FindFraction(double time) const
{
  const double length = this->End - this->Begin;
  const double fraction = length > 0.0 ? (time - this->Begin) / length : 0.0;
  return std::min(std::max(fraction, 0.0), 1.0);
}

bool MovingTarget::IsAt(int step, double fraction) const
{
  return step == this->Step && fraction == this->Fraction;
}

// Places the target unless it is already placed. Returns true if its position changes.
bool MovingTarget::PlaceOnce(double fraction)
{
  const bool moves = !this->IsAt(this->FirstStep, fraction);
  if (moves || !this->IsPlaced)
  {
    this->ForgetPlace();
    this->Place(this->FirstStep, fraction);
    this->Step = this->FirstStep;
    this->Fraction = fraction;
    this->IsPlaced = true;
  }
  return moves;
}

}
