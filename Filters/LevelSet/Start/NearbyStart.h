/**
 * Initial potential of a function whose surface is in known boxes, or near known points.
 */
#ifndef NearbyStart_h
#define NearbyStart_h

#include "Base/InitialFunction.h"
#include "Base/Motion.h"
#include "Base/OpenVDB.h"

namespace activesurface
{

/**
 * Returns a potential with the same surface as that of MakeInitialPotential, up to rounding. The
 * signs are sampled only in the leaves that the function's regions touch. Outside these leaves, the
 * inside is filled from inside nodes across faces, without evaluations. Returns null if `progress`
 * cancelled the sampling.
 */
openvdb::FloatTree::Ptr MakeSparsePotential(double voxelSize, const double bounds[6],
  const InitialFunction& function, std::size_t maximumNumberOfActiveVoxels,
  const ProgressFunction& progress);

/**
 * Returns a potential bitwise identical to that of MakeInitialPotential. The function is sampled
 * only at the nodes near the points, and near those faces of the bounds that meet
 * SurfacePoints::Bounds. Returns null if `progress` cancelled the sampling.
 */
openvdb::FloatTree::Ptr MakeNearbyPotential(double voxelSize, const double bounds[6],
  const InitialFunction& function, std::size_t maximumNumberOfActiveVoxels,
  const ProgressFunction& progress);

}

#endif
