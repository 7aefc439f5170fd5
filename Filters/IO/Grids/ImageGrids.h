// The point arrays of a vtkImageData as grids.

#ifndef ImageGrids_h
#define ImageGrids_h

#include "OpenVDB.h"

class vtkDataArray;
class vtkImageData;

namespace activesurface
{

// Places the index coordinates of an image's points. Throws std::invalid_argument where they have
// no place.
openvdb::math::Transform::Ptr MakeImageTransform(vtkImageData* image);

// Values are active where they are not the background, which is 0. For a level set, which has to be
// of one component on cubic voxels, it is 3 voxels, and what is beyond is clamped. Throws
// std::invalid_argument for arrays that do not fit.
openvdb::GridBase::Ptr MakeImageGrid(
  vtkImageData* image, vtkDataArray* array, openvdb::GridClass kind);

}

#endif
