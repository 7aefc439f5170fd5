#include "Pipeline/SkinFunction.h"

#include "Surface/SkinDistance.h"

#include "vtkGridPotential.h"

#include <utility>

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

SkinSamples::SkinSamples(
  std::shared_ptr<const SkinDistance> skin, const std::array<double, 3>& origin)
  : Skin(std::move(skin))
  , Origin(origin)
{
}

SkinSamples::~SkinSamples() = default;

double SkinSamples::Evaluate(const double x[3], double* gradient) const
{
  const double relative[3] = { x[0] - this->Origin[0], x[1] - this->Origin[1],
    x[2] - this->Origin[2] };
  return this->Skin->Evaluate(relative, gradient);
}

bool SkinSamples::GetBounds(double bounds[6]) const
{
  const bool hasSurface = this->Skin->GetBounds(bounds);
  for (int i = 0; hasSurface && i < 6; ++i)
  {
    bounds[i] += this->Origin[i / 2];
  }
  return hasSurface;
}

}
