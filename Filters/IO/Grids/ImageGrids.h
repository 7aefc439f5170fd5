// Converts the point arrays of a vtkImageData to grids.

#ifndef ImageGrids_h
#define ImageGrids_h

#include "Base/OpenVDB.h"

class vtkDataArray;
class vtkImageData;

namespace activesurface
{

// Returns a grid whose values other than the background are active. The background is 0, for a
// level set 3 voxels. A level set needs one component and cubic voxels; its values are clamped to
// +-3 voxels. Throws std::invalid_argument for unsuitable arrays.
openvdb::GridBase::Ptr MakeImageGrid(
  vtkImageData* image, vtkDataArray* array, openvdb::GridClass kind);

}

#endif
