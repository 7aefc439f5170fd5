/** Reads a mesh or an image by a vtkGridPotential, and finds the shape's surface and connected
 * parts. */

#ifndef GridFunction_h
#define GridFunction_h

#include "Base/InitialFunction.h"
#include "Base/TargetRegion.h"

#include <array>
#include <string>

class vtkDataSet;
class vtkGridPotential;
class vtkImplicitFunction;

namespace activesurface
{

struct TargetOptions;

/**
 * Sets the input of a function, and reads this input. The other properties of the function have to
 * be set before. Throws std::runtime_error for unusable data. The caller has to report defects.
 */
void ReadGrid(vtkGridPotential* grid, vtkDataSet* data);

/**
 * Returns a message about parts thinner than two voxels; empty if these are at most 0.5 % of the
 * surface, and for functions other than vtkGridPotential.
 */
std::string DescribeThinParts(vtkImplicitFunction* function, double voxelSize);

/** Returns true if the parts of a function are available. */
bool KnowsParts(vtkImplicitFunction* function, const TargetOptions& options);

/**
 * Visits the parts of the shape F < iso, or F > iso if inverted; none if the parts are unavailable.
 * Points of the parts are relative to the origin.
 */
void ForEachPartOf(vtkImplicitFunction* function, const TargetOptions& options,
  const PartVisitor& visit, const std::array<double, 3>& origin = {});

/** Returns points near the surface; none if unavailable or if options.Invert. */
SurfacePoints FindSurfaceOf(vtkImplicitFunction* function, const TargetOptions& options);

}

#endif
