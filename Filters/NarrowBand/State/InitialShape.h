/**
 * The initial potential: distances near the zero set of a function.
 */
#ifndef InitialShape_h
#define InitialShape_h

#include "InitialFunction.h"
#include "Motion.h"
#include "OpenVDB.h"

#include <cstddef>

namespace activesurface
{

/**
 * The lattice within the bounds is sampled plane by plane; two planes are kept. The nodes near sign
 * changes get distances (InitialDistances.h). If the function is negative at a face of the bounds,
 * the shape is closed half a voxel inside it. A value that is not a number counts as outside.
 *
 * Returns a tree of u with background Far, inside tiles -Far; null if `progress` stopped it. Throws
 * as NarrowBand::Start does.
 */
openvdb::FloatTree::Ptr MakeInitialPotential(double voxelSize, const double bounds[6],
  const InitialFunction& function, std::size_t maximumNumberOfActiveVoxels,
  const ProgressFunction& progress);

/** Throws std::runtime_error: the band needs more than so many active voxels. */
[[noreturn]] void RefuseSize(std::size_t maximumNumberOfActiveVoxels);

}

#endif
