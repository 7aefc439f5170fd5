/**
 * Curvature and speed at the vertices of the skin, in the order in which Skin writes them.
 */
#ifndef SkinMotion_h
#define SkinMotion_h

#include "ActiveLevelSetExport.h"
#include "Base/SkinForces.h"

#include <vector>

namespace activesurface
{

class NarrowBand;

/**
 * Returns the sum of the principal curvatures [1/length], positive where the skin bulges outward:
 * eq. (5) of the paper (NarrowBand.h) at the nodes, interpolated along the edges. Clamped to +-4
 * per voxel at the nodes.
 */
ACTIVELEVELSET_EXPORT std::vector<float> FindCurvatures(const NarrowBand& band);

/**
 * Returns the normal speed [length/time], outward positive, by the equation of motion (Motion.h) at
 * the time of the band: attraction, tension, penalties, and the uniform speed by which exact
 * controls conserve volume or area. The attraction is 0 where the value of the target is not
 * finite. For the node scheme see SkinMotion.cxx.
 */
ACTIVELEVELSET_EXPORT std::vector<float> FindSpeeds(
  const NarrowBand& band, const SkinForces& forces);

}

#endif
