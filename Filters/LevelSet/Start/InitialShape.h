/**
 * The initial potential: distances near the zero set of a function.
 */
#ifndef InitialShape_h
#define InitialShape_h

#include "Base/InitialFunction.h"
#include "Base/Motion.h"
#include "Base/OpenVDB.h"

#include <cstddef>

namespace activesurface
{

/**
 * Samples the lattice within the bounds plane by plane, and keeps two planes. Nodes near sign
 * changes get distances (InitialDistances.h). If the function is negative at a face of the bounds,
 * the shape is closed about half a voxel inside the outermost nodes. NaN counts as outside.
 *
 * Returns a tree of u with background Far and inside tiles -Far; null if `progress` cancelled the
 * sampling. Throws like NarrowBand::Start.
 */
openvdb::FloatTree::Ptr MakeInitialPotential(double voxelSize, const double bounds[6],
  const InitialFunction& function, std::size_t maximumNumberOfActiveVoxels,
  const ProgressFunction& progress);

/** Throws std::runtime_error: the band needs more active voxels than the maximum. */
[[noreturn]] void RefuseSize(std::size_t maximumNumberOfActiveVoxels);

}

#endif
