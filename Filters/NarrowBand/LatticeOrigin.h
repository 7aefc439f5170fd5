/**
 * Where a lattice has its node (0, 0, 0), so that single precision holds positions on it.
 */
#ifndef LatticeOrigin_h
#define LatticeOrigin_h

#include <cmath>

namespace activesurface
{

/**
 * World position of that node along one axis, for data within bounds: 0 if these come within 2^17
 * voxels of 0, where floats are exact to a 64th of a voxel; else near their centre, in steps of
 * 2^16 voxels, so that runs over neighbouring data mostly have the same one. 0 too for bounds that
 * are not finite, or more than 10^9 voxels apart: they are for the caller to refuse.
 */
inline double FindLatticeOrigin(double low, double high, double voxelSize)
{
  constexpr double farthest = 1 << 17;
  constexpr double step = 1 << 16;
  constexpr double widest = 1e9;
  const double centre = 0.5 * (low + high) / voxelSize;
  const bool isFar = std::isfinite(centre) && std::fmax(low, -high) >= farthest * voxelSize;
  return isFar && high - low < widest * voxelSize ? std::round(centre / step) * step * voxelSize
                                                  : 0.0;
}

}

#endif
