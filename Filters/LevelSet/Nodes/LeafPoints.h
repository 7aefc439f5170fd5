/**
 * Interpolation between the 27 points of a LeafMotion, which are 4 nodes apart.
 */
#ifndef LeafPoints_h
#define LeafPoints_h

#include "Base/FloatLanes.h"

namespace activesurface
{

/** Returns the numbers at the eight nodes of row (x, y), interpolated linearly between the points.
 */
ACTIVE_ALWAYS_INLINE Lanes ExpandRow(const float* points, int x, int y)
{
  const float tx = .25f * static_cast<float>(x & 3), ty = .25f * static_cast<float>(y & 3);
  float line[3];
  for (int k = 0; k < 3; ++k)
  {
    const float* p = points + 9 * (x >> 2) + 3 * (y >> 2) + k;
    line[k] = (1.f - tx) * ((1.f - ty) * p[0] + ty * p[3]) + tx * ((1.f - ty) * p[9] + ty * p[12]);
  }
  const Lanes quarters = { 0.f, .25f, .5f, .75f, 1.f, 1.25f, 1.5f, 1.75f };
  const Lanes lower = AllLanes(line[0]) + quarters * AllLanes(line[1] - line[0]);
  const Lanes upper = AllLanes(line[1]) + (quarters - AllLanes(1.f)) * AllLanes(line[2] - line[1]);
  return Pick(quarters < AllLanes(1.f), lower, upper);
}

}

#endif
