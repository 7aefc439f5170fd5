// Grids of a triangulated surface: its distance and its point arrays.

#ifndef SkinGrids_h
#define SkinGrids_h

#include "Grids/SkinBand.h"

class vtkDataArray;

namespace activesurface
{

// Throws std::invalid_argument for sizes that a .vdb file cannot hold.
void CheckGridVoxel(double voxelSize);

// Returns the level set "surface": distances [world units], with node (0, 0, 0) at the world's
// origin.
openvdb::FloatGrid::Ptr MakeSurfaceGrid(const MeshBand& band, double voxelSize);

// Returns "density", a fog: 1 inside, falling to 0 at the surface over the last 3 voxels
// (HalfWidth).
openvdb::FloatGrid::Ptr MakeDensityGrid(const openvdb::FloatGrid& surface);

// Returns a point array's values at the nodes near the surface. Values of floating-point grids (see
// DispatchValues) are interpolated on the nearest triangle. Values of integer grids are those of
// the corner with the largest weight in this interpolation. Throws std::invalid_argument unless the
// array has one or three components.
openvdb::GridBase::Ptr MakeArrayGrid(
  vtkDataArray* array, const LatticeMesh& mesh, const MeshBand& band);

}

#endif
