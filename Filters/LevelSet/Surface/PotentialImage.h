/**
 * The potential on a box of the lattice, as a distance.
 */
#ifndef PotentialImage_h
#define PotentialImage_h

#include "ActiveLevelSetExport.h"

namespace activesurface
{

class NarrowBand;

/**
 * Writes the signed distance to the surface [world units], negative inside, at the lattice nodes
 * extent[0]..extent[1], extent[2]..extent[3], extent[4]..extent[5], x fastest. The distance is the
 * potential divided by its gradient norm. It is of first order: exact at the surface, good within
 * about 1.5 voxels. It is clamped to +-HalfWidth voxels, the value beyond the band.
 */
ACTIVELEVELSET_EXPORT void WriteDistances(
  const NarrowBand& band, const int extent[6], float* distances);

}

#endif
