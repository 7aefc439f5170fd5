/**
 * The implicit function of a mesh or an image.
 */
#ifndef GridFunction_h
#define GridFunction_h

#include <string>

class vtkDataSet;
class vtkGridPotential;
class vtkImplicitFunction;

namespace activesurface
{

/**
 * Gives the data to a function whose other properties are set, and has it read them. Throws
 * std::runtime_error for data that cannot be used; defects are left to the caller.
 */
void ReadGrid(vtkGridPotential* grid, vtkDataSet* data);

/** What a user should know of its parts that are thinner than two voxels, as a sentence; empty if
 * they are a negligible share of its surface. */
std::string DescribeThinParts(vtkImplicitFunction* function, double voxelSize);

}

#endif
