/** Surface points and connected parts of a function; available for meshes and images. */
#ifndef GridParts_h
#define GridParts_h

#include "Base/InitialFunction.h"
#include "Base/TargetRegion.h"

#include <array>

class vtkImplicitFunction;

namespace activesurface
{

struct TargetOptions;

/** Returns true if the parts of a function are available. */
bool KnowsParts(vtkImplicitFunction* function, const TargetOptions& options);

/**
 * Visits the parts of the shape F < iso, or F > iso if inverted; none if the parts are unavailable.
 * Points of the parts are relative to the origin.
 */
void ForEachPartOf(vtkImplicitFunction* function, const TargetOptions& options,
  const PartVisitor& visit, const std::array<double, 3>& origin = {});

/** Returns points near the surface; none if they are unavailable or the inside is unbounded. */
SurfacePoints FindSurfaceOf(vtkImplicitFunction* function, const TargetOptions& options);

}

#endif
