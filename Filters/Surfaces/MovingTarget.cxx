#include "MovingTarget.h"

#include <algorithm>

namespace activesurface
{

void MovingTarget::MoveAlong(int step, double begin, double end)
{
  this->Begin = begin;
  this->End = end;
  this->PlaceOnce(step, 0.0);
}

void MovingTarget::MoveTo(double time)
{
  const double length = this->End - this->Begin;
  const double fraction = length > 0.0 ? (time - this->Begin) / length : 0.0;
  this->PlaceOnce(this->Step, std::min(std::max(fraction, 0.0), 1.0));
}

void MovingTarget::PlaceOnce(int step, double fraction)
{
  if (step != this->Step || fraction != this->Fraction)
  {
    this->Step = step;
    this->Fraction = fraction;
    this->Place(step, fraction);
  }
}

}
