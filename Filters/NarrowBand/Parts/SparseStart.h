/**
 * The initial potential of a function that tells where its surface can be.
 */
#ifndef SparseStart_h
#define SparseStart_h

#include "InitialFunction.h"
#include "Motion.h"
#include "OpenVDB.h"

namespace activesurface
{

/**
 * As MakeInitialPotential, at a cost proportional to the function's regions, whatever the bounds.
 * The leaves that the regions touch are sampled. From the nodes that are inside, what is in no
 * region is filled leaf by leaf, without evaluations.
 */
openvdb::FloatTree::Ptr MakeSparsePotential(double voxelSize, const double bounds[6],
  const InitialFunction& function, std::size_t maximumNumberOfActiveVoxels,
  const ProgressFunction& progress);

}

#endif
