// The chosen volumes of a .vdb file as an image.

#ifndef ImageReading_h
#define ImageReading_h

#include "Grids/VDBSeries.h"

#include "vtkType.h"

class vtkImageData;

namespace activesurface
{

struct ImageRequest
{
  openvdb::CoordBBox Box;     // voxels
  bool IsPart = false;        // other than the box of the active voxels
  int DownsamplingFactor = 1; // every so many voxels are read
  bool IsDense = true;        // else a level set is attached alone, without point arrays
  vtkIdType MaximumNumberOfPoints = 0;
};

// Throws std::exception if the image would be too large, or the file cannot be read.
void ReadImage(const VDBSeries& series, const ImageRequest& request, vtkImageData* image);

}

#endif
