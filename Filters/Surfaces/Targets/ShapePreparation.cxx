#include "Targets/ShapePreparation.h"

#include "Targets/ParticleFrame.h"

#include <sstream>
#include <stdexcept>

namespace activesurface
{

namespace
{

// Reach of the particles in units of their distance, when it is not given: balls of neighbours
// overlap enough to be one body.
constexpr double RadiusPerSpacing = 2.0;

}

double ShapePreparation::GetRadius() const
{
  return this->EstimatedRadius > 0.0 ? this->EstimatedRadius : this->Options.ParticleRadius;
}

void ShapePreparation::GiveRadius(ParticleFrame& frame)
{
  if (frame.HasRadii || frame.Particles.empty())
  {
    return;
  }
  if (this->Options.ParticleRadius == 0.0 && this->EstimatedRadius == 0.0)
  {
    this->EstimatedRadius = RadiusPerSpacing * frame.GetSpacing();
    if (this->EstimatedRadius == 0.0)
    {
      throw std::invalid_argument(
        "The particles' radius cannot be estimated, as no two of them are "
        "apart; set ParticleRadius or choose a radius array.");
    }
    std::ostringstream text;
    text << "ParticleRadius is not set; " << this->EstimatedRadius << " is used, "
         << RadiusPerSpacing << " times the usual distance of neighbours. Set it to silence this.";
    this->Report("radius", text.str());
  }
  frame.GiveRadius(this->GetRadius());
}

}
