// Reads the chosen volumes of a .vdb file as an image.

#ifndef ImageReading_h
#define ImageReading_h

#include "Grids/GridChoice.h"

#include "vtkType.h"

class vtkImageData;

namespace activesurface
{

struct ImageRequest
{
  openvdb::CoordBBox Box;     // voxels
  bool IsPart = false;        // true if Box is not the box of the active voxels
  int DownsamplingFactor = 1; // stride in voxels
  bool IsDense = true;        // false: only attaches a level set, without point arrays
  vtkIdType MaximumNumberOfPoints = 0;
};

// Throws std::exception if the image would be too large, or the file cannot be read.
void ReadImage(const ChosenGrids& chosen, const ImageRequest& request, vtkImageData* image);

}

#endif
