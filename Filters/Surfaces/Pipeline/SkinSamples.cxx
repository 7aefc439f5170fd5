#include "Pipeline/SkinSamples.h"

#include "SkinDistance.h"

#include <utility>

namespace activesurface
{

SkinSamples::SkinSamples(std::shared_ptr<const SkinDistance> skin)
  : Skin(std::move(skin))
{
}

SkinSamples::~SkinSamples() = default;

double SkinSamples::Evaluate(const double x[3], double* gradient) const
{
  return this->Skin->Evaluate(x, gradient);
}

bool SkinSamples::GetBounds(double bounds[6]) const
{
  return this->Skin->GetBounds(bounds);
}

}
