// Any shapes as a target that goes from step to step: F = (1 - f) F0 + f F1 at a fraction f of the
// way, where F0 and F1 are the functions of the two steps.

#ifndef BlendedTarget_h
#define BlendedTarget_h

#include "Targets/FunctionSampler.h"
#include "Targets/MovingTarget.h"
#include "Targets/TargetFrames.h"

#include "vtkImplicitFunction.h"
#include "vtkSmartPointer.h"

#include <memory>

namespace activesurface
{

class BlendedTarget : public MovingTarget
{
public:
  // The frames are the caller's, have to hold what MoveAlong asks for, and functions where they are
  // not empty. differences: the step of FunctionSampler. outside: the value of a frame without a
  // function, an empty one.
  // knowsParts: whether the functions tell of their parts, see GridParts.h.
  BlendedTarget(const TargetFrames& frames, double differences, double outside, bool knowsParts,
    const TargetOptions& options);

  bool IsThreadSafe() const override;
  bool HasRegions() const override { return this->KnowsParts; }
  // The parts of both steps.
  void ForEachPart(const PartVisitor& visit) const override;
  SurfacePoints FindSurface() const override;

protected:
  void Place(int step, double fraction) override;
  void Sample(
    std::size_t count, const double* points, double* values, double* gradients) const override;

private:
  struct Shape
  {
    int Step = -1;
    std::unique_ptr<FunctionSampler> Function; // null: nothing is there
    vtkSmartPointer<vtkImplicitFunction> Source;
  };

  void Take(int step, Shape& shape) const;
  void SampleShape(const Shape& shape, std::size_t count, const double* points, double* values,
    double* gradients) const;

  const TargetFrames& Frames;
  const double Differences;
  const double Outside;
  const bool KnowsParts;
  double Blend = 0.0; // of the later shape
  Shape Earlier, Later;
};

}

#endif
