/**
 * Which points lie outside the surface, each by more than a distance of its own.
 */
#ifndef PointsOutside_h
#define PointsOutside_h

#include "ActiveNarrowBandExport.h"

#include <cstddef>
#include <vector>

namespace activesurface
{

class NarrowBand;

struct PointWithMargin
{
  double Position[3]; //< world units, as Margin
  double Margin;      //< >= 0
};

/**
 * How many of the points are outside and farther than their margins from all triangles of the skin;
 * all of them if there is no surface. Margins may be wider than the band. A point without finite
 * numbers does not count.
 *
 * One look at the potential for a point inside or far away, else one at each voxel within the
 * margin; no memory. The result does not depend on the threads.
 */
ACTIVENARROWBAND_EXPORT std::size_t CountOutside(
  const NarrowBand& band, const std::vector<PointWithMargin>& points);

}

#endif
