// Target that moves between the functions of two steps.

#ifndef BlendedTarget_h
#define BlendedTarget_h

#include "Targets/FunctionSampler.h"
#include "Targets/MovingTarget.h"

#include "vtkImplicitFunction.h"
#include "vtkSmartPointer.h"

#include <memory>

namespace activesurface
{

class TargetFrames;

// F = (1 - f) F0 + f F1 at the fraction f of the interval. F0 and F1 are the functions of the two
// steps.
class BlendedTarget : public MovingTarget
{
public:
  // The caller owns the frames, which must contain the steps that MoveAlong uses; each step that is
  // not empty must have a function. outside: value of a frame without a function. knowsParts: the
  // parts of the functions are available (GridFunction.h).
  BlendedTarget(
    const TargetFrames& frames, double outside, bool knowsParts, const TargetOptions& options);

  bool IsThreadSafe() const override;
  bool HasRegions() const override { return this->KnowsParts; }
  // Visits the parts of the earlier step and, at a fraction > 0, of the later step.
  void ForEachPart(const PartVisitor& visit) const override;
  SurfacePoints FindSurface() const override;

protected:
  void Place(int step, double fraction) override;
  void Sample(
    std::size_t count, const double* points, double* values, double* gradients) const override;

  struct Shape
  {
    int Step = -1;
    std::unique_ptr<FunctionSampler> Function; // null for an empty frame
    vtkSmartPointer<vtkImplicitFunction> Source;
  };

  void SampleShape(const Shape& shape, std::size_t count, const double* points, double* values,
    double* gradients) const;

  const TargetFrames& Frames;
  double Blend = 0.0; // weight of the later shape
  Shape Earlier, Later;

private:
  void Use(int step, Shape& shape) const;

  const double Outside;
  const bool KnowsParts;
};

}

#endif
