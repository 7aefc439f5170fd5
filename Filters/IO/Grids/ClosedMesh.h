// Converts a closed vtkPolyData to triangles on a lattice.

#ifndef ClosedMesh_h
#define ClosedMesh_h

#include "Grids/LatticeMesh.h"

class vtkPolyData;

namespace activesurface
{

// Returns the triangles of ReadTriangles; points keep their indices. A voxelSize of 0 becomes a
// 64th of the longest side of the mesh's bounds. origin: becomes the world position of the
// lattice's node (0, 0, 0). Throws std::invalid_argument for a mesh without polygons or that is not
// closed (see MeshTriangles.h). The same holds for points that are not finite or do not exist.
LatticeMesh ReadClosedMesh(vtkPolyData* data, double& voxelSize, std::array<double, 3>& origin);

}

#endif
