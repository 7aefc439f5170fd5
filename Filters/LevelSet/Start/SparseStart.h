/**
 * Initial potential of a function that provides regions that contain its surface.
 */
#ifndef SparseStart_h
#define SparseStart_h

#include "Base/InitialFunction.h"
#include "Base/Motion.h"
#include "Base/OpenVDB.h"

namespace activesurface
{

/**
 * Equals MakeInitialPotential, at a cost proportional to the function's regions, whatever the
 * bounds. The function is sampled in the leaves that the regions touch. Space outside the regions
 * is filled from inside nodes leaf by leaf, without evaluations.
 */
openvdb::FloatTree::Ptr MakeSparsePotential(double voxelSize, const double bounds[6],
  const InitialFunction& function, std::size_t maximumNumberOfActiveVoxels,
  const ProgressFunction& progress);

}

#endif
