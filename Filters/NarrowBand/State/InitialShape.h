/**
 * The starting potential: a function's zero set, as distances near it.
 */
#ifndef InitialShape_h
#define InitialShape_h

#include "InitialFunction.h"
#include "Motion.h"

#include <openvdb/openvdb.h>

namespace activesurface
{

/**
 * The lattice within the bounds is visited plane by plane, of which two are held; the nodes near
 * sign changes get distances (InitialDistances.h).
 * Where the function is negative at the faces of the bounds, the shape is closed half a voxel
 * inside them. A value that is not a number counts as outside.
 *
 * Returns a tree of u with background Far, inside tiles -Far, or null when `progress` stopped it.
 * Throws as NarrowBand::Start says.
 */
openvdb::FloatTree::Ptr MakeInitialPotential(double voxelSize, const double bounds[6],
  const InitialFunction& function, std::size_t maximumNumberOfActiveVoxels,
  const ProgressFunction& progress);

}

#endif
