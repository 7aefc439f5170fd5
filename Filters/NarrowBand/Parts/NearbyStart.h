/**
 * The initial potential of a function whose surface is known by points.
 */
#ifndef NearbyStart_h
#define NearbyStart_h

#include "InitialFunction.h"
#include "Motion.h"
#include "OpenVDB.h"

namespace activesurface
{

/**
 * As MakeInitialPotential, to the bit, at a cost proportional to the points. The function is
 * sampled at the nodes near them, and where the bounds close it.
 */
openvdb::FloatTree::Ptr MakeNearbyPotential(double voxelSize, const double bounds[6],
  const InitialFunction& function, std::size_t maximumNumberOfActiveVoxels,
  const ProgressFunction& progress);

}

#endif
