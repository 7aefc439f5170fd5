// A closed vtkPolyData as triangles on a lattice.

#ifndef ClosedMesh_h
#define ClosedMesh_h

#include "Grids/LatticeMesh.h"

class vtkPolyData;

namespace activesurface
{

// The triangles of ReadTriangles; the points keep their numbers. Voxels of size 0 become a 64th of
// the longest side of the mesh's bounds. Throws std::invalid_argument for a mesh that is not closed
// (see MeshTriangles.h), without polygons, or with points that are not finite or do not exist.
// origin: becomes the world position of the lattice's node (0, 0, 0).
LatticeMesh ReadClosedMesh(vtkPolyData* data, double& voxelSize, std::array<double, 3>& origin);

}

#endif
