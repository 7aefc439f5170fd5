// Any vtkImplicitFunction as a target.

#ifndef ImplicitTarget_h
#define ImplicitTarget_h

#include "Targets/FunctionSampler.h"
#include "Targets/GridFunction.h"
#include "Targets/PotentialTarget.h"

#include "vtkImplicitFunction.h"
#include "vtkSmartPointer.h"

namespace activesurface
{

class ImplicitTarget : public PotentialTarget
{
public:
  // origin: see FunctionSampler.
  ImplicitTarget(vtkImplicitFunction* function, const TargetOptions& options,
    const std::array<double, 3>& origin = {})
    : PotentialTarget(options)
    , Source(function)
    , Function(function, options.GetDifferenceStep(), origin)
    , Origin(origin)
  {
  }

  bool IsThreadSafe() const override { return this->Function.IsThreadSafe(); }
  // The function must not change while the surface advances (FunctionSampler).
  bool MayHaveChanged(const double[6]) const override { return false; }

  bool HasRegions() const override { return KnowsParts(this->Source, this->GetOptions()); }
  void ForEachPart(const PartVisitor& visit) const override
  {
    ForEachPartOf(this->Source, this->GetOptions(), visit, this->Origin);
  }
  SurfacePoints FindSurface() const override
  {
    const bool isAtOrigin = this->Origin == std::array<double, 3>{};
    return isAtOrigin ? FindSurfaceOf(this->Source, this->GetOptions()) : SurfacePoints();
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
  std::array<double, 3> Origin; // of the target's points, not the points of Source
};

}

#endif
