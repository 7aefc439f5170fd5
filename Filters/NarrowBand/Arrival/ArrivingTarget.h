/**
 * A target that stands still, as it attracts a surface that is to arrive at a given time: its value
 * is how far the surface still has to go.
 */
#ifndef ArrivingTarget_h
#define ArrivingTarget_h

#include "Arrival/RemainingDistance.h"
#include "Target.h"

namespace activesurface
{

class ArrivingTarget : public Target
{
public:
  /** All are the caller's. */
  ArrivingTarget(Target& goal, const RemainingDistance& remaining, double voxelSize)
    : Goal(goal)
    , Remaining(remaining)
    , VoxelSize(voxelSize)
  {
  }

  /** To be called when the attraction changes: then converged leaves may move again. */
  void Wake() { this->IsAwake = this->HasWoken = true; }

  void MoveTo(double time) override;
  bool MayHaveChanged(const double bounds[6]) const override;
  void Evaluate(
    std::size_t count, const double* points, const TargetResults& results) const override;
  bool IsThreadSafe() const override { return this->Goal.IsThreadSafe(); }

private:
  void Lengthen(double remaining, double& value, double& slope) const;

  Target& Goal;
  const RemainingDistance& Remaining;
  const double VoxelSize;
  bool IsAwake = true;  //< in this substep
  bool HasWoken = true; //< before it
};

}

#endif
