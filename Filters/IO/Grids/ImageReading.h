// Reads the chosen volumes of a .vdb file as an image.

#ifndef ImageReading_h
#define ImageReading_h

#include "VDBFile.h"

#include "vtkType.h"

#include <string>
#include <vector>

class vtkImageData;

namespace activesurface
{

// A validated file and the grids to read from the file: volumes of one transform, or one grid of
// points.
struct ChosenGrids
{
  std::string FileName;
  VDBFile File;
  std::vector<VDBGrid> Grids;

  bool AreOfPoints() const;
  // Bounding box of the active voxels.
  openvdb::CoordBBox FindActiveBox() const;
};

// Chooses grids by name; without names, chooses the first level set, else the first fog volume,
// else the first grid of points, else the first other grid. Throws std::exception if the file
// cannot be read. Throws std::invalid_argument if a name is unknown (with a list of the grids), a
// grid cannot be read, or several grids are not volumes of one transform.
ChosenGrids ChooseGrids(const std::string& fileName, const std::vector<std::string>& names);

// Position and size of an image whose points are every `factor`th voxel of a grid.
struct ImagePlace
{
  int Extent[6] = { 0, -1, 0, -1, 0, -1 };
  double Origin[3] = { 0.0, 0.0, 0.0 };
  double Spacing[3] = { 1.0, 1.0, 1.0 };
  double Direction[9] = { 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0 };

  double CountPoints() const; // a double, because the count may exceed any integer type
};

// Returns the place of the image that covers a box of voxels (an empty box: empty extent). Throws
// std::invalid_argument if the axes of the transform are not at right angles.
ImagePlace MakeImagePlace(
  const openvdb::math::Transform& transform, const openvdb::CoordBBox& box, int factor);

// Returns a box of voxels from index coordinates (x min, x max...). Throws std::invalid_argument
// for a box that is empty or extends beyond 2^30.
openvdb::CoordBBox FindVoxels(const int region[6]);

// Returns the voxels that cover a box in world space (x min, x max...). Throws
// std::invalid_argument for a box that is empty, not finite or too far away.
openvdb::CoordBBox FindVoxels(const openvdb::math::Transform& transform, const double bounds[6]);

struct ImageRequest
{
  openvdb::CoordBBox Box;     // voxels
  bool IsPart = false;        // true if Box is not the box of the active voxels
  int DownsamplingFactor = 1; // stride in voxels
  bool IsDense = true;        // false: only attaches a level set, without point arrays
  vtkIdType MaximumNumberOfPoints = 0;
};

// Reads the chosen volumes into the image. Throws std::exception if the image would be too large,
// or the file cannot be read.
void ReadImage(const ChosenGrids& chosen, const ImageRequest& request, vtkImageData* image);

}

#endif
