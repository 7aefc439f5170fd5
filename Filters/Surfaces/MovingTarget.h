// A target that goes from one step of the input to the next.

#ifndef MovingTarget_h
#define MovingTarget_h

#include "PotentialTarget.h"

namespace activesurface
{

class MovingTarget : public PotentialTarget
{
public:
  using PotentialTarget::PotentialTarget;

  // From now on it goes from this step to the next between two motion times, and begins at once.
  // Without a next step, or if end = begin, it stays.
  void MoveAlong(int step, double begin, double end);

  void MoveTo(double time) override;

protected:
  // At a fraction in [0,1] of the way from this step to the next.
  virtual void Place(int step, double fraction) = 0;

private:
  void PlaceOnce(int step, double fraction);

  int Step = -1;
  double Begin = 0.0;
  double End = 0.0;
  double Fraction = 0.0;
};

}

#endif
