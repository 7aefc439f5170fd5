/**
 * World position of a lattice's node (0, 0, 0), chosen so that single precision represents the
 * lattice.
 */
#ifndef LatticeOrigin_h
#define LatticeOrigin_h

#include <cmath>

namespace activesurface
{

/**
 * Returns the world coordinate of node (0, 0, 0) along one axis, for data within bounds. The
 * coordinate is 0 if the bounds come within 2^17 voxels of 0, where floats are exact to 1/64 voxel.
 * Otherwise the coordinate is near the centre of the bounds, in steps of 2^16 voxels, so that runs
 * over neighbouring data mostly share the coordinate. Returns 0 too if the bounds are not finite,
 * or 10^9 voxels or more apart; the caller has to reject such bounds.
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
