#include "Targets/ShapePreparation.h"

#include "Frames/ParticleFrame.h"
#include "Frames/ParticleSpacing.h"
#include "Index/Skeleton.h"
#include "Targets/InputShape.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

namespace activesurface
{

double ShapePreparation::GetSpacing() const
{
  return this->Options.ParticleSpacing > 0.0 ? this->Options.ParticleSpacing
                                             : this->EstimatedSpacing;
}

double ShapePreparation::GetRadius(ParticleModel model) const
{
  return this->Options.KernelRadius > 0.0 ? this->Options.KernelRadius
                                          : GetReachPerSpacing(model) * this->GetSpacing();
}

double ShapePreparation::GetReachPerRadius(ParticleModel model) const
{
  const double level = this->Options.Threshold;
  const bool hasLevel = model == ParticleModel::Sum && level > 0.0 && level < 1.0;
  return hasLevel ? 1.0 / FindRadiusOfLevel(this->Options.Kernel, level)
                  : 2.0 * GetReachPerSpacing(model);
}

void ShapePreparation::GiveRadius(ParticleModel model, ParticleFrame& frame)
{
  if (frame.CountAllParticles() == 0)
  {
    return;
  }
  const bool hasReach = frame.HasRadii || this->Options.KernelRadius > 0.0;
  if (this->GetSpacing() == 0.0 && (model != ParticleModel::Sum || !hasReach))
  {
    this->EstimateSpacing(model, frame);
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

double ShapePreparation::FindSpacingOf(const ParticleFrame& frame, const PeriodicBox& box)
{
  ParticleFrame wrapped;
  if (box.Any())
  {
    for (SkeletonVertex particle : frame.Particles)
    {
      box.Wrap(particle.Position);
      wrapped.Particles.Add(particle);
    }
  }
  const double spacing = FindSpacing(box.Any() ? wrapped : frame);
  if (!frame.HasRadii || frame.Particles.empty())
  {
    return spacing;
  }
  const double diameter = 2.0 * FindMedianRadius(frame) / frame.ReachPerRadius;
  return spacing > 0.0 ? std::min(spacing, diameter) : diameter; // balls may be far apart
}

void ShapePreparation::EstimateSpacing(ParticleModel model, const ParticleFrame& frame)
{
  this->EstimatedSpacing = FindSpacingOf(frame, this->Options.Box);
  if (this->EstimatedSpacing == 0.0)
  {
    this->EstimatedSpacing = this->Options.KernelRadius / GetReachPerSpacing(model);
  }
  if (this->EstimatedSpacing == 0.0)
  {
    throw std::invalid_argument("The particles' spacing cannot be estimated, because all particles "
                                "are at one point; set ParticleSpacing or KernelRadius, or choose "
                                "an array of radii.");
  }
  this->ReportSpacing(frame.HasRadii);
}

void ShapePreparation::ReportSpacing(bool haveRadii) const
{
  if (haveRadii || this->Options.KernelRadius > 0.0)
  {
    return;
  }
  std::ostringstream text;
  text << "Neither ParticleSpacing nor KernelRadius is set, so a ParticleSpacing of "
       << this->EstimatedSpacing << " is used, the usual distance of neighbours. Set "
       << "ParticleSpacing to silence this message.";
  this->Note("spacing", text.str());
}

std::string PrepareShape(InputShape& shape, ShapePreparation& preparation, const std::string& where)
{
  try
  {
    const std::string flaw = shape.Prepare(preparation);
    return flaw.empty() ? "" : where + flaw;
  }
  catch (const std::runtime_error& error)
  {
    throw std::runtime_error(where + error.what());
  }
}

}
