// Samples of a sparse level set, which is attached to an image instead of pixels. The value,
// +-(voxel - IsoValue), is trilinear between voxels. Voxels beyond the band have plus or minus the
// background of the level set.

#ifndef LevelSetSamples_h
#define LevelSetSamples_h

#include "Base/OpenVDB.h"
#include "Grid/GridSamples.h"
#include "Grid/ImageSamples.h"

namespace activesurface
{

class LevelSetSamples : public GridSamples
{
public:
  // Keeps the grid. Throws std::invalid_argument, with a message, for a grid without active voxels
  // or a level that is not finite.
  LevelSetSamples(const openvdb::FloatGrid::ConstPtr& grid, const ImageLevel& level);
  ~LevelSetSamples() override;

  double Evaluate(const double x[3], double* gradient) const override;
  bool GetBounds(double bounds[6]) const override;
  bool FindShape(double level, LatticeShape& shape) const override;

private:
  openvdb::FloatGrid::ConstPtr Grid;
  double IsoValue;
  double Sign; // factor of the samples: -1 exchanges the sides
  openvdb::Mat4d ToIndex;
  openvdb::CoordBBox Box; // of the active voxels
};

}

#endif
