// Distance to the skin of a NarrowBand, as grid samples.

#ifndef SkinSamples_h
#define SkinSamples_h

#include "Grid/GridSamples.h"

#include <array>
#include <memory>

namespace activesurface
{

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

}

#endif
