// Converts the point arrays of a vtkImageData to grids.

#ifndef ImageGrids_h
#define ImageGrids_h

#include "Base/OpenVDB.h"

class vtkDataArray;
class vtkImageData;

namespace activesurface
{

// Returns a grid whose active values are those other than 0 or, in a level set, those within 3
// voxels of the surface. A level set needs one component and cubic voxels; inactive values are +-3
// voxels. Throws std::invalid_argument for unsuitable arrays, and for voxels whose volume is 0 or
// too small for OpenVDB.
openvdb::GridBase::Ptr MakeImageGrid(
  vtkImageData* image, vtkDataArray* array, openvdb::GridClass kind);

}

#endif
