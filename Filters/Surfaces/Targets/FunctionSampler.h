// Values and gradients of any vtkImplicitFunction.
//
// Uses the function's own gradient if this is reliable, otherwise central differences. VTK's
// vtkImplicitBoolean returns the gradient of a difference for a union and an intersection. A
// vtkImplicitBoolean without a transform is therefore evaluated term by term, and the term that
// determines the value provides the gradient. The sign of this gradient may be wrong; the
// gradient's length is correct.

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
  // step: step of the central differences [world units]. origin: points are relative to this
  // position. The function must not change during the sampler's lifetime.
  FunctionSampler(
    vtkImplicitFunction* function, double step, const std::array<double, 3>& origin = {});
  ~FunctionSampler();

  // Returns true if the function has no transform and is of a class whose objects evaluation does
  // not change (list in FunctionSampler.cxx). For a vtkImplicitBoolean without a transform, returns
  // true if all terms are thread-safe.
  bool IsThreadSafe() const;

  // Evaluates the function at points (x y z each). gradients may be null.
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
