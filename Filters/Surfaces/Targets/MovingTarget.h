// A target that goes from one step of the input to the next.

#ifndef MovingTarget_h
#define MovingTarget_h

#include "Targets/PotentialTarget.h"

namespace activesurface
{

class MovingTarget : public PotentialTarget
{
public:
  using PotentialTarget::PotentialTarget;

  // From now on it goes from this step to the next between two motion times, and begins at once.
  // Without a next step, or if end = begin, it stays.
  void MoveAlong(int step, double begin, double end);

  // Comes between MoveAlong and an evaluation before the first MoveTo.
  void Complete();

  void MoveTo(double time) override;
  bool MayHaveChanged(const double bounds[6]) const override;

protected:
  // At a fraction in [0,1] of the way from this step to the next.
  virtual void Place(int step, double fraction) = 0;

  // What has been placed is to be placed again, the same.
  void ForgetPlace() { this->IsPlaced = this->IsFinished = false; }

  // The rest of it, for all other evaluations: once after a Place, or not at all.
  virtual void Finish() {}

  // Where it is at a time: the step that its way begins at, and the fraction of the way.
  int GetStepOfWay() const { return this->Way; }
  double FindFraction(double time) const;

  // From the step to the next one [motion time]; 0 where it stays.
  double GetDuration() const { return this->End - this->Begin; }

  // Whether the last Place may have changed values in a box.
  virtual bool HasChangedIn(const double bounds[6]) const;

private:
  enum class Change
  {
    Nothing,
    LastPlace,
    Everything
  };

  bool IsAt(int step, double fraction) const;
  bool PlaceOnce(double fraction);

  int Way = -1; // the step that it begins at
  double Begin = 0.0;
  double End = 0.0;
  int Step = -1; // where it is, or is to be placed again; -1: nowhere
  double Fraction = 0.0;
  bool IsPlaced = false;
  bool HasJumped = true;              // other than by MoveTo
  Change Recent = Change::Everything; // with the last MoveTo
  bool IsFinished = false;
};

}

#endif
