#include "Targets/TargetOptions.h"

#include "Frames/ParticleFrame.h"
#include "Index/Skeleton.h"

namespace activesurface
{

double TargetOptions::GetRadius(ParticleModel model) const
{
  return this->KernelRadius > 0.0 ? this->KernelRadius : GetReachPerSpacing(model) * this->Spacing;
}

double TargetOptions::GetReachPerRadius(ParticleModel model) const
{
  const bool hasLevel =
    model == ParticleModel::Sum && this->Threshold > 0.0 && this->Threshold < 1.0;
  return hasLevel ? 1.0 / FindRadiusOfLevel(this->Kernel, this->Threshold)
                  : 2.0 * GetReachPerSpacing(model);
}

void TargetOptions::GiveRadii(ParticleModel model, ParticleFrame& frame) const
{
  if (frame.CountAllParticles() == 0)
  {
    return;
  }
  if (frame.HasRadii)
  {
    frame.UseRadii(this->GetReachPerRadius(model));
  }
  else
  {
    frame.GiveRadius(this->GetRadius(model));
  }
}

}
