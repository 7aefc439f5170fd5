// Values in use for properties that the filter can set automatically.

#ifndef ValuesInUse_h
#define ValuesInUse_h

#include "Base/Motion.h"

namespace activesurface
{

class TargetBuilder;

// In world units and motion time; 0: none, or unknown.
struct ValuesInUse
{
  double VoxelSize = 0.0;
  double ParticleSpacing = 0.0;
  double Attraction = 0.0;
  double Tension = 0.0;
};

// motion: parameters by which the skin moved.
ValuesInUse FindValuesInUse(const Motion& motion, const TargetBuilder& shapes);

}

#endif
