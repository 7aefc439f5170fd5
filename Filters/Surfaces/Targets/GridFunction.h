/**
 * The implicit function of a mesh or an image.
 */
#ifndef GridFunction_h
#define GridFunction_h

class vtkDataSet;
class vtkGridPotential;

namespace activesurface
{

/**
 * Gives the data to a function whose other properties are set, and has it read them. Throws
 * std::runtime_error for data that cannot be used; defects are left to the caller.
 */
void ReadGrid(vtkGridPotential* grid, vtkDataSet* data);

}

#endif
