// What a skin was made with, where properties leave it to the filter.

#ifndef ValuesInUse_h
#define ValuesInUse_h

#include "Motion.h"

namespace activesurface
{

class TargetBuilder;

// Lengths in world units, rates per motion time; 0: there is none.
struct ValuesInUse
{
  double VoxelSize = 0.0;
  double ParticleSpacing = 0.0;
  double Attraction = 0.0;
  double Tension = 0.0;
};

// motion: of the skin.
ValuesInUse FindValuesInUse(const Motion& motion, const TargetBuilder& shapes);

}

#endif
