// Target that moves between the shapes of two steps: F = (1 - f) F0 + f F1 at the fraction f of the
// interval, where F0 and F1 are the functions of the two steps.

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
  // The caller owns the frames. They must contain the steps that MoveAlong uses; each step that is
  // not empty must have a function. differences: step of the central differences (FunctionSampler).
  // outside: value of a frame without a function. knowsParts: the parts of the functions are
  // available (GridParts.h).
  BlendedTarget(const TargetFrames& frames, double differences, double outside, bool knowsParts,
    const TargetOptions& options);

  bool IsThreadSafe() const override;
  bool HasRegions() const override { return this->KnowsParts; }
  // Visits the parts of both steps.
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
    std::unique_ptr<FunctionSampler> Function; // null for an empty frame
    vtkSmartPointer<vtkImplicitFunction> Source;
  };

  void Take(int step, Shape& shape) const;
  void SampleShape(const Shape& shape, std::size_t count, const double* points, double* values,
    double* gradients) const;

  const TargetFrames& Frames;
  const double Differences;
  const double Outside;
  const bool KnowsParts;
  double Blend = 0.0; // weight of the later shape
  Shape Earlier, Later;
};

}

#endif
