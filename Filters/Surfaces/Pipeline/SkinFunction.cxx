#include "Pipeline/SkinFunction.h"

#include "Pipeline/SkinSamples.h"
#include "Surface/SkinDistance.h"

#include "vtkGridPotential.h"

namespace activesurface
{

SkinFunction::SkinFunction() = default;

SkinFunction::~SkinFunction() = default;

vtkGridPotential* SkinFunction::Get(const NarrowBand* band, const std::array<double, 3>& origin)
{
  if (!this->Function)
  {
    this->Function = vtkSmartPointer<vtkGridPotential>::New();
    this->Renew(band, origin);
  }
  return this->Function;
}

void SkinFunction::Renew(const NarrowBand* band, const std::array<double, 3>& origin)
{
  if (this->Function)
  {
    this->Function->SetSamples(band
        ? std::make_shared<SkinSamples>(std::make_shared<SkinDistance>(*band), origin)
        : nullptr);
  }
}

}
