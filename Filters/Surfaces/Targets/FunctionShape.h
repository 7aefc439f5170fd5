/**
 * A shape given by an implicit function. The shape copies the input's points and cells, and shares
 * the values of an image with the input (ImageShape.cxx).
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
   * Returns a copy with only the points and cells. A copy is needed because the next step may
   * overwrite the input.
   */
  static vtkSmartPointer<vtkDataSet> CopyPointsAndCells(vtkDataSet* data);

  /**
   * Returns a target that interpolates between the functions of the frames. outside: value of an
   * empty frame.
   */
  std::unique_ptr<MovingTarget> MakeBlend(
    const TargetFrames& frames, double outside, const TargetOptions& options) const;

  /** Returns true if the parts of the functions are available (GridFunction.h). */
  virtual bool KnowsParts() const { return true; }

  void MoveBy(const double offset[3]) override;

  vtkSmartPointer<vtkDataSet> Data;
  vtkSmartPointer<vtkImplicitFunction> Function; //< null before Prepare
};

}

#endif
