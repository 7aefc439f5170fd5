// Any shapes as a target that goes from step to step: F = (1 - f) F0 + f F1 at a fraction f of the
// way, where F0 and F1 are the functions of the two steps.

#ifndef BlendedTarget_h
#define BlendedTarget_h

#include "Targets/FunctionSampler.h"
#include "Targets/MovingTarget.h"
#include "Targets/TargetFrames.h"

#include <memory>

namespace activesurface
{

class BlendedTarget : public MovingTarget
{
public:
  // The frames are the caller's, have to hold what MoveAlong asks for, and functions where they are
  // not empty. differences: the step of FunctionSampler. outside: the value of a frame without a
  // function, an empty one.
  BlendedTarget(
    const TargetFrames& frames, double differences, double outside, const TargetOptions& options);

  bool IsThreadSafe() const override;

protected:
  void Place(int step, double fraction) override;
  void Sample(
    std::size_t count, const double* points, double* values, double* gradients) const override;

private:
  struct Shape
  {
    int Step = -1;
    std::unique_ptr<FunctionSampler> Function; // null: nothing is there
  };

  void Take(int step, Shape& shape) const;
  void SampleShape(const Shape& shape, std::size_t count, const double* points, double* values,
    double* gradients) const;

  const TargetFrames& Frames;
  const double Differences;
  const double Outside;
  double Blend = 0.0; // of the later shape
  Shape Earlier, Later;
};

}

#endif
