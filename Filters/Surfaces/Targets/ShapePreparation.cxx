#include "Targets/ShapePreparation.h"

#include "Targets/InputShape.h"
#include "Targets/ParticleFrame.h"
#include "Targets/ParticleSpacing.h"

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
  return this->Options.ParticleRadius > 0.0 ? this->Options.ParticleRadius
                                            : GetReachPerSpacing(model) * this->GetSpacing();
}

void ShapePreparation::GiveRadius(ParticleModel model, ParticleFrame& frame)
{
  if (frame.CountAll() == 0)
  {
    return;
  }
  const bool hasReach = frame.HasRadii || this->Options.ParticleRadius > 0.0;
  if (this->GetSpacing() == 0.0 && (model != ParticleModel::Sum || !hasReach))
  {
    this->EstimateSpacing(model, frame);
  }
  if (!frame.HasRadii)
  {
    frame.GiveRadius(this->GetRadius(model));
  }
}

void ShapePreparation::EstimateSpacing(ParticleModel model, const ParticleFrame& frame)
{
  const bool hasReach = frame.HasRadii || this->Options.ParticleRadius > 0.0;
  this->EstimatedSpacing = FindSpacing(frame);
  if (this->EstimatedSpacing == 0.0 && hasReach)
  {
    const double reach = frame.HasRadii ? FindFirstRadius(frame) : this->Options.ParticleRadius;
    this->EstimatedSpacing = reach / GetReachPerSpacing(model);
  }
  if (this->EstimatedSpacing == 0.0)
  {
    throw std::invalid_argument("The particles' spacing cannot be estimated, as no two of them are "
                                "apart; set ParticleSpacing or ParticleRadius, or choose a radius "
                                "array.");
  }
  if (!hasReach)
  {
    std::ostringstream text;
    text << "Neither ParticleSpacing nor ParticleRadius is set; a ParticleSpacing of "
         << this->EstimatedSpacing << " is used, the usual distance of neighbours. Set it to "
         << "silence this.";
    this->Report("spacing", text.str());
  }
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
