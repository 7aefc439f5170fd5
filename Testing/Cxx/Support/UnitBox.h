/**
 * Domain of the exact tests and the benchmarks, and motions of attraction and tension.
 */
#ifndef UnitBox_h
#define UnitBox_h

#include "Base/Motion.h"

namespace activesurface
{
/** [-1,1]^3. */
constexpr double Box[6] = { -1.0, 1.0, -1.0, 1.0, -1.0, 1.0 };

/** Voxel size for n nodes along each side of Box. */
constexpr double VoxelSizeOf(int n)
{
  return 2.0 / (n - 1);
}

inline Motion MakeMotion(double attraction, double tension)
{
  Motion motion;
  motion.Attraction = attraction;
  motion.Tension = tension;
  return motion;
}
}

#endif
