// Implicit function of a surface's skin, for other filters.

#ifndef SkinFunction_h
#define SkinFunction_h

#include "vtkSmartPointer.h"

#include "Grid/GridSamples.h"

#include <array>
#include <memory>

class vtkGridPotential;

namespace activesurface
{

class NarrowBand;
class SkinDistance;

class SkinSamples : public GridSamples
{
public:
  // Positions in the skin are relative to the origin.
  SkinSamples(std::shared_ptr<const SkinDistance> skin, const std::array<double, 3>& origin);
  ~SkinSamples() override;

  double Evaluate(const double x[3], double* gradient) const override;
  bool GetBounds(double bounds[6]) const override;

private:
  std::shared_ptr<const SkinDistance> Skin;
  std::array<double, 3> Origin;
};

class SkinFunction
{
public:
  SkinFunction();
  ~SkinFunction();

  // Returns the function, which is always the same object. The first call makes the function from
  // the skin of `band`; Renew replaces the skin. band: null for a function that is positive
  // everywhere. Positions in the band are relative to `origin`.
  vtkGridPotential* Get(const NarrowBand* band, const std::array<double, 3>& origin);

  // Replaces the skin by a snapshot of the skin of `band`, if Get has been called before.
  void Renew(const NarrowBand* band, const std::array<double, 3>& origin);

private:
  vtkSmartPointer<vtkGridPotential> Function; // null until the first call of Get
};

}

#endif
