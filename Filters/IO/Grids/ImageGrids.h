// Converts the point arrays of a vtkImageData to grids.

#ifndef ImageGrids_h
#define ImageGrids_h

#include "Base/OpenVDB.h"

class vtkDataArray;
class vtkImageData;

namespace activesurface
{

// Returns a grid with the background 0; values that differ from the background are active. A level
// set needs one component and cubic voxels. The background of a level set is 3 voxels, and values
// are clamped to +-3 voxels. Throws std::invalid_argument for unsuitable arrays.
openvdb::GridBase::Ptr MakeImageGrid(
  vtkImageData* image, vtkDataArray* array, openvdb::GridClass kind);

}

#endif
