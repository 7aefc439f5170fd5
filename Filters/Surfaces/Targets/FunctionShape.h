/**
 * A shape that is told by an implicit function, made of a copy of the input's data.
 */
#ifndef FunctionShape_h
#define FunctionShape_h

#include "Targets/InputShape.h"

#include "vtkDataSet.h"
#include "vtkImplicitFunction.h"
#include "vtkSmartPointer.h"

namespace activesurface
{

struct TargetOptions;

class FunctionShape : public InputShape
{
public:
  vtkImplicitFunction* GetFunction() const override { return this->Function; }

protected:
  explicit FunctionShape(vtkSmartPointer<vtkDataSet> data);

  /**
   * A copy of points and cells alone: what comes through the input may be written over by the next
   * step.
   */
  static vtkSmartPointer<vtkDataSet> CopyPointsAndCells(vtkDataSet* data);

  /** Between the functions of the frames; outside: the value of an empty frame. */
  std::unique_ptr<MovingTarget> MakeBlend(const TargetFrames& frames, const ShapeOptions& options,
    double outside, const TargetOptions& level) const;

  /** Whether the functions tell of their parts, see GridParts.h. */
  virtual bool KnowsParts() const { return true; }

  void MoveBy(const double offset[3]) override;

  vtkSmartPointer<vtkDataSet> Data;
  vtkSmartPointer<vtkImplicitFunction> Function; //< null until it is prepared
};

}

#endif
