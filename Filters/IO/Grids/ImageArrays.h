// Converts grids to point arrays of images.

#ifndef ImageArrays_h
#define ImageArrays_h

#include "OpenVDB.h"
#include "vtkSmartPointer.h"

class vtkDataArray;

namespace activesurface
{

// Returns the values of every `factor`th voxel in an extent. Throws std::invalid_argument for grids
// of other types than numbers and vectors.
vtkSmartPointer<vtkDataArray> MakeImageArray(
  const openvdb::GridBase& grid, const int extent[6], int factor);

}

#endif
