// Bounds, lattice and target reach of a surface, from the settings and the first shapes.

#ifndef SurfaceDomain_h
#define SurfaceDomain_h

#include "vtkBoundingBox.h"

#include <array>

namespace activesurface
{

struct SurfaceSettings;

struct SurfaceDomain
{
  // World position of the lattice node (0, 0, 0), the origin of all positions in the simulation. A
  // coordinate is 0 if the bounds come within 2^17 voxels of 0 along this axis, otherwise near the
  // centre of the bounds (LatticeOrigin.h).
  std::array<double, 3> Origin = {};
  double Bounds[6] = {}; // relative to Origin
  double VoxelSize = 0.0;
  double Reach = 0.0; // of the target [length]

  // Finds the first and last index, along each axis, of the smallest box of nodes that contains the
  // bounds. Returns false if an index would be +-10^9 or beyond.
  bool GetExtent(int extent[6]) const;
};

// Bounds and sizes from the first frame of the target and the initial shape.
struct FirstShapes
{
  vtkBoundingBox Shapes;  // of shapes that are not images
  vtkBoundingBox Images;  // of images
  double ParticleSpacing; // [length]; 0: does not determine the voxel size
  double Pixel;           // of the finest image [length]; 0: no image
};

// Makes the domain from the bounds of the settings.
SurfaceDomain MakeDomain(const SurfaceSettings& settings);

// Makes the domain from the boxes of the target and the initial shape. The box of all shapes except
// images is enlarged by an eighth of its longest side at each end. If there are images, the common
// box of images and shapes is enlarged at each end by two voxels (of VoxelSize or, if automatic,
// the size for images).
SurfaceDomain MakeDomain(const SurfaceSettings& settings, const FirstShapes& first);

// Makes a domain without extent, for a start on an empty frame. Requires HasOwnSizes() of the
// settings or a spacing > 0.
SurfaceDomain MakeDomainOfNothing(const SurfaceSettings& settings, double particleSpacing);

}

#endif
