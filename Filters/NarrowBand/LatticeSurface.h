/**
 * Where the surface of a shape on a lattice is.
 */
#ifndef LatticeSurface_h
#define LatticeSurface_h

#include "ActiveNarrowBandExport.h"
#include "InitialFunction.h"

namespace activesurface
{

struct LatticeShape;

/**
 * The centres of the cells whose corners differ in sign: a function that is interpolated between
 * the nodes has its zero set there. Not known if tiles of both sides meet.
 */
ACTIVENARROWBAND_EXPORT SurfacePoints FindSurfacePoints(const LatticeShape& shape);

}

#endif
