// Values and gradients of any vtkImplicitFunction.
//
// Gradients are the function's own where they can be trusted, else central differences. VTK's
// vtkImplicitBoolean gives a union and an intersection the gradient of a difference: it is taken
// apart here, and the term that decides gives the gradient.

#ifndef FunctionSampler_h
#define FunctionSampler_h

#include <array>
#include <cstddef>
#include <memory>

class vtkImplicitFunction;

namespace activesurface
{

class FunctionSampler
{
public:
  // step: of the central differences [world units]; origin: what the points are relative to. The
  // function must not change meanwhile.
  FunctionSampler(
    vtkImplicitFunction* function, double step, const std::array<double, 3>& origin = {});
  ~FunctionSampler();

  // True for the functions whose evaluation is known to leave them unchanged.
  bool IsThreadSafe() const;

  // At points (x y z each); gradients may be null.
  void Sample(std::size_t count, const double* points, double* values, double* gradients) const;

  struct Node;

private:
  void SampleWorld(
    std::size_t count, const double* points, double* values, double* gradients) const;

  std::unique_ptr<Node> Root;
  std::array<double, 3> Origin;
};

}

#endif
