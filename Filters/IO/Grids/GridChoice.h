// Which grids of a .vdb file are read, and which part of them.

#ifndef GridChoice_h
#define GridChoice_h

#include "VDBFile.h"

#include <string>
#include <vector>

namespace activesurface
{

// By name; without names the most sensible one. Volumes of one transform, or one grid of points.
// Throws std::invalid_argument, naming what is there.
std::vector<VDBGrid> ChooseGrids(const VDBFile& file, const std::vector<std::string>& names);

// Place and size of an image whose points are every so many voxels of a grid.
struct ImagePlace
{
  int Extent[6] = { 0, -1, 0, -1, 0, -1 };
  double Origin[3] = { 0.0, 0.0, 0.0 };
  double Spacing[3] = { 1.0, 1.0, 1.0 };
  double Direction[9] = { 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0 };

  double CountPoints() const; // no integer: it may be absurd
};

// Throws std::invalid_argument for a transform that is no rotation and scale.
ImagePlace MakeImagePlace(
  const openvdb::math::Transform& transform, const openvdb::CoordBBox& box, int factor);

// A box in index coordinates (x min, x max...). Throws std::invalid_argument for one that is empty
// or beyond 2^30.
openvdb::CoordBBox FindVoxels(const int region[6]);

// Voxels that cover a box in space (x min, x max...). Throws std::invalid_argument for one that is
// empty, not finite or too far away.
openvdb::CoordBBox FindVoxels(const openvdb::math::Transform& transform, const double bounds[6]);

}

#endif
