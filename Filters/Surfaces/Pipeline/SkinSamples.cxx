#include "Pipeline/SkinSamples.h"

#include "Surface/SkinDistance.h"

#include <utility>

namespace activesurface
{

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
