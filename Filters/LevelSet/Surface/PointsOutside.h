/** Counts the points that are outside the surface by more than their margins. */
#ifndef PointsOutside_h
#define PointsOutside_h

#include "ActiveLevelSetExport.h"

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
 * Returns the number of points that are outside and farther than their margins from all triangles
 * of the skin. Without a surface all finite points count. Margins may be wider than the band.
 * Points with numbers that are not finite do not count.
 *
 * For each point, reads the voxel of the potential that contains the point. If the point is outside
 * and its margin meets the leaves, also reads the voxels of the leaves within the margin. The
 * result does not depend on the number of threads.
 */
ACTIVELEVELSET_EXPORT std::size_t CountOutside(
  const NarrowBand& band, const std::vector<PointWithMargin>& points);

}

#endif
