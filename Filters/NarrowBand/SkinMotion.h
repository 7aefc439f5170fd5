/**
 * Curvature and speed at the vertices of the skin, in the order in which Skin writes them.
 */
#ifndef SkinMotion_h
#define SkinMotion_h

#include "ActiveNarrowBandExport.h"
#include "SkinForces.h"

#include <vector>

namespace activesurface
{

class NarrowBand;

/**
 * Sum of the principal curvatures [1/length], positive where the skin bulges outward: eq. (5) of
 * the paper at the nodes, interpolated along the edges; at most 4 per voxel.
 */
ACTIVENARROWBAND_EXPORT std::vector<float> FindCurvatures(const NarrowBand& band);

/**
 * Normal speed [length/time], outward positive, by the equation of motion at the time of the band:
 * attraction, tension, penalties, and for exact controls the uniform speed that holds what they
 * hold. Attraction is 0 where the target is not finite. In the node scheme: see NodeSpeeds.h.
 */
ACTIVENARROWBAND_EXPORT std::vector<float> FindSpeeds(
  const NarrowBand& band, const SkinForces& forces);

}

#endif
