// A target that moves from one step of the input to the next.

#ifndef MovingTarget_h
#define MovingTarget_h

#include "Targets/PotentialTarget.h"

namespace activesurface
{

class MovingTarget : public PotentialTarget
{
public:
  using PotentialTarget::PotentialTarget;

  // Sets the motion: from `step` to the next step between two motion times. Until the next MoveTo,
  // the target is at `step`. The target stays at `step` if the next step is not stored, or if end =
  // begin.
  void MoveAlong(int step, double begin, double end);

  // Call this after MoveAlong if the target is evaluated before the first MoveTo.
  void Complete();

  void MoveTo(double time) override;
  // Returns the fraction of the interval at a time.
  double FindFraction(double time) const;
  bool MayHaveChanged(const double[6]) const override { return this->HasChanged; }

protected:
  // Places the target at a fraction in [0,1] of the interval from this step to the next.
  virtual void Place(int step, double fraction) = 0;

  // Makes the next MoveTo or Complete place the target again.
  void ForgetPlace() { this->IsPlaced = this->IsFinished = false; }

  // Completes Place for evaluations. Called at most once after each Place.
  virtual void Finish() {}

  // Step at which the current motion begins.
  int GetFirstStep() const { return this->FirstStep; }

  // Duration that MoveAlong has set, end - begin [motion time].
  double GetDuration() const { return this->End - this->Begin; }

private:
  bool IsAt(int step, double fraction) const;
  bool PlaceOnce(double fraction);

  int FirstStep = -1; // step at which the motion begins
  double Begin = 0.0;
  double End = 0.0;
  int Step = -1; // current step, or the step to place again; -1: none
  double Fraction = 0.0;
  bool IsPlaced = false;
  bool HasJumped = true;  // changed by another call than MoveTo
  bool HasChanged = true; // by the last MoveTo
  bool IsFinished = false;
};

}

#endif
