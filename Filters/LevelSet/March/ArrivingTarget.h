/**
 * A static target for a surface that has to arrive at a given time. Its value is the remaining
 * distance of the surface.
 */
#ifndef ArrivingTarget_h
#define ArrivingTarget_h

#include "Base/Target.h"
#include "March/RemainingDistance.h"

namespace activesurface
{

class ArrivingTarget : public Target
{
public:
  /** The caller owns all arguments. */
  ArrivingTarget(Target& goal, const RemainingDistance& remaining, double voxelSize)
    : Goal(goal)
    , Remaining(remaining)
    , VoxelSize(voxelSize)
  {
  }

  /** Called when the attraction changes: converged leaves may then move again. */
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
  bool IsAwake = true;  //< in the current substep
  bool HasWoken = true; //< before the current substep
};

}

#endif
