// Any vtkImplicitFunction as a target.
//
// Gradients are the function's own where they can be trusted, else central differences. VTK's
// vtkImplicitBoolean gives a union and an intersection the gradient of a difference: it is taken
// apart here, and the term that decides gives the gradient.

#ifndef ImplicitTarget_h
#define ImplicitTarget_h

#include "PotentialTarget.h"

#include <memory>

class vtkImplicitFunction;

namespace activesurface
{

class ImplicitTarget : public PotentialTarget
{
public:
  // step: of the central differences [world units]. The function must not change meanwhile.
  ImplicitTarget(vtkImplicitFunction* function, double step, const TargetOptions& options);
  ~ImplicitTarget() override;

  // True for the functions whose evaluation is known to leave them unchanged.
  bool IsThreadSafe() const override;

  struct Node;

protected:
  void Sample(
    std::size_t count, const double* points, double* values, double* gradients) const override;

private:
  std::unique_ptr<Node> Root;
};

}

#endif
