/**
 * A shape with a formula as an implicit function of VTK.
 */
#ifndef ShapeFunction_h
#define ShapeFunction_h

#include "Support/AnalyticShapes.h"

#include "vtkImplicitFunction.h"
#include "vtkObjectFactory.h"
#include "vtkSmartPointer.h"

#include <algorithm>

namespace activesurface
{

class ShapeFunction : public vtkImplicitFunction
{
public:
  static ShapeFunction* New() { VTK_STANDARD_NEW_BODY(ShapeFunction); }
  vtkTypeMacro(ShapeFunction, vtkImplicitFunction);

  using vtkImplicitFunction::EvaluateFunction;
  double EvaluateFunction(double x[3]) override { return this->Form.Value({ x[0], x[1], x[2] }); }
  void EvaluateGradient(double x[3], double gradient[3]) override
  {
    const Point at = GetGradient(this->Form, { x[0], x[1], x[2] });
    std::copy(at.begin(), at.end(), gradient);
  }

  Shape Form = MakeConstant(1.0);
};

inline vtkSmartPointer<ShapeFunction> MakeFunction(const Shape& shape)
{
  auto function = vtkSmartPointer<ShapeFunction>::New();
  function->Form = shape;
  return function;
}

}

#endif
