/** Functions for the vtkGridPotential of a mesh or an image. */
#ifndef GridFunction_h
#define GridFunction_h

#include <string>

class vtkDataSet;
class vtkGridPotential;
class vtkImplicitFunction;

namespace activesurface
{

/**
 * Sets the input of a function, and reads this input. The other properties of the function have to
 * be set before. Throws std::runtime_error for unusable data. The caller has to report defects.
 */
void ReadGrid(vtkGridPotential* grid, vtkDataSet* data);

/**
 * Returns a message about parts thinner than two voxels; empty if these are a negligible fraction
 * of the surface.
 */
std::string DescribeThinParts(vtkImplicitFunction* function, double voxelSize);

}

#endif
