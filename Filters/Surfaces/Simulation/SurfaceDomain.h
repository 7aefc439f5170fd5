// Where a surface starts and at which resolution: known from the bounds.

#ifndef SurfaceDomain_h
#define SurfaceDomain_h

#include "vtkBoundingBox.h"

#include <array>

namespace activesurface
{

struct SurfaceSettings;

struct SurfaceDomain
{
  // World position of the lattice node (0, 0, 0), which all positions within the simulation are
  // relative to: a multiple of VoxelSize near the bounds, 0 along an axis where that is near.
  std::array<double, 3> Origin = {};
  double Bounds[6] = {}; // relative to Origin
  double VoxelSize = 0.0;
  double Reach = 0.0;

  // Lattice nodes within the bounds, first and last of each axis; false if there are too many.
  bool GetExtent(int extent[6]) const;
};

// What the targets and the initial shape tell.
struct FirstShapes
{
  vtkBoundingBox Shapes;
  vtkBoundingBox Images;
  double ParticleSpacing; // 0: there are no particles, or it is not known
  double Pixel;           // of the finest image [length]; 0: there is none
};

// With the bounds given by the settings.
SurfaceDomain MakeDomain(const SurfaceSettings& settings);

// With the box of the target and the initial shape: shapes enlarged by a quarter of their longest
// side, half of it at each end, and with images by two voxels at each end.
SurfaceDomain MakeDomain(const SurfaceSettings& settings, const FirstShapes& first);

// Before anything is there: without an extent. The settings have their own sizes, or the spacing is
// known.
SurfaceDomain MakeDomainOfNothing(const SurfaceSettings& settings, double particleSpacing);

}

#endif
