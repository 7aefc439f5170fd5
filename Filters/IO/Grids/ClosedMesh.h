// A closed vtkPolyData as triangles on a lattice.

#ifndef ClosedMesh_h
#define ClosedMesh_h

#include "Grids/LatticeMesh.h"

class vtkPolyData;

namespace activesurface
{

// Polygons and strips; the points keep their numbers. Voxels of size 0 become a 64th of the longest
// side of the bounds. Throws std::invalid_argument for a mesh that is not closed: points of equal
// coordinates count as one, and each edge has to be in two triangles, or an even number of them.
LatticeMesh ReadClosedMesh(vtkPolyData* data, double& voxelSize);

}

#endif
