// Any vtkImplicitFunction as a target.

#ifndef ImplicitTarget_h
#define ImplicitTarget_h

#include "Targets/FunctionSampler.h"
#include "Targets/GridParts.h"
#include "Targets/PotentialTarget.h"

#include "vtkImplicitFunction.h"
#include "vtkSmartPointer.h"

namespace activesurface
{

class ImplicitTarget : public PotentialTarget
{
public:
  // As of FunctionSampler.
  ImplicitTarget(vtkImplicitFunction* function, double step, const TargetOptions& options)
    : PotentialTarget(options)
    , Source(function)
    , Function(function, step)
  {
  }

  bool IsThreadSafe() const override { return this->Function.IsThreadSafe(); }
  // The function does not change while the surface advances: see FunctionSampler.
  bool MayHaveChanged(const double[6]) const override { return false; }

  bool HasRegions() const override { return KnowsParts(this->Source, this->GetOptions()); }
  void ForEachPart(const PartVisitor& visit) const override
  {
    ForEachPartOf(this->Source, this->GetOptions(), visit);
  }
  SurfacePoints FindSurface() const override
  {
    return FindSurfaceOf(this->Source, this->GetOptions());
  }

protected:
  void Sample(
    std::size_t count, const double* points, double* values, double* gradients) const override
  {
    this->Function.Sample(count, points, values, gradients);
  }

private:
  vtkSmartPointer<vtkImplicitFunction> Source;
  FunctionSampler Function;
};

}

#endif
