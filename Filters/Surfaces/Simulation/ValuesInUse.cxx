#include "Simulation/ValuesInUse.h"

#include "Simulation/TargetBuilder.h"

namespace activesurface
{

ValuesInUse FindValuesInUse(const Motion& motion, const TargetBuilder& shapes)
{
  ValuesInUse values;
  const SurfaceDomain* domain = shapes.GetDomain();
  values.VoxelSize = domain ? domain->VoxelSize : 0.0;
  values.ParticleSpacing = shapes.FindSpacing();
  values.Attraction = motion.Attraction;
  values.Tension = motion.Tension;
  return values;
}

}
