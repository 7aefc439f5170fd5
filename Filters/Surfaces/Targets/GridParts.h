/**
 * Where the surface of a function is, and its parts: known of meshes and images.
 */
#ifndef GridParts_h
#define GridParts_h

#include "InitialFunction.h"
#include "TargetRegion.h"

#include <array>

class vtkImplicitFunction;

namespace activesurface
{

struct TargetOptions;

/** Whether they are known. */
bool KnowsParts(vtkImplicitFunction* function, const TargetOptions& options);

/** Of F - iso, or of iso - F if it is inverted; none where they are not known. Their points are
 * given relative to an origin. */
void ForEachPartOf(vtkImplicitFunction* function, const TargetOptions& options,
  const PartVisitor& visit, const std::array<double, 3>& origin = {});

/** None where it is not known, or the inside has no end. */
SurfacePoints FindSurfaceOf(vtkImplicitFunction* function, const TargetOptions& options);

}

#endif
