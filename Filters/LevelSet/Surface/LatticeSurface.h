/**
 * Points near the surface of a shape on a lattice.
 */
#ifndef LatticeSurface_h
#define LatticeSurface_h

#include "ActiveLevelSetExport.h"
#include "Base/InitialFunction.h"

namespace activesurface
{

struct LatticeShape;

/**
 * Returns the centres of the cells whose corners differ in sign. A function that is interpolated
 * between the nodes has its zero set in these cells. Leaves ForEach empty (points unknown) if an
 * inside tile touches an outside tile.
 */
ACTIVELEVELSET_EXPORT SurfacePoints FindSurfacePoints(const LatticeShape& shape);

}

#endif
