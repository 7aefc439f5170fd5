// The grids of a surface that is known by triangles: its distance, and what its points hold.

#ifndef SkinGrids_h
#define SkinGrids_h

#include "Grids/LatticeMesh.h"

class vtkDataArray;

namespace activesurface
{

// "surface", a level set [world units] with the exact transform of the lattice. Throws
// std::invalid_argument for voxels that are too small for OpenVDB.
openvdb::FloatGrid::Ptr MakeSurfaceGrid(const MeshBand& band, double voxelSize);

// "density", a fog: 1 inside, falling to 0 at the surface within the half width.
openvdb::FloatGrid::Ptr MakeDensityGrid(const openvdb::FloatGrid& surface);

// What an array holds for each point of the mesh, at the nodes near the surface: interpolated on
// the nearest triangle, integers taken from its nearest corner. Throws std::invalid_argument for
// arrays of other than one or three components.
openvdb::GridBase::Ptr MakeArrayGrid(
  vtkDataArray* array, const LatticeMesh& mesh, const MeshBand& band);

}

#endif
