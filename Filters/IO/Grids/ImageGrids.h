// Converts the point arrays of a vtkImageData to grids.

#ifndef ImageGrids_h
#define ImageGrids_h

#include "Base/OpenVDB.h"

class vtkDataArray;
class vtkImageData;

namespace activesurface
{

// Returns a grid whose active values are those that differ from the background, 0. A level set
// needs one component and cubic voxels. Its background is 3 voxels, and values beyond are clamped.
// Throws std::invalid_argument for unsuitable arrays.
openvdb::GridBase::Ptr MakeImageGrid(
  vtkImageData* image, vtkDataArray* array, openvdb::GridClass kind);

}

#endif
