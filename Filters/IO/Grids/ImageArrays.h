// Grids as point arrays of images.

#ifndef ImageArrays_h
#define ImageArrays_h

#include "OpenVDB.h"
#include "vtkSmartPointer.h"

class vtkDataArray;

namespace activesurface
{

// The values at the nodes of an extent, every `factor`th of the grid's. Throws
// std::invalid_argument for a grid of another type than numbers and vectors.
vtkSmartPointer<vtkDataArray> MakeImageArray(
  const openvdb::GridBase& grid, const int extent[6], int factor);

}

#endif
