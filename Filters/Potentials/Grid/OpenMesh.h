// The inside of a mesh with holes, by generalized winding numbers.

#ifndef OpenMesh_h
#define OpenMesh_h

#include "Grid/MeshDistance.h"

namespace activesurface
{

// Makes a signed distance like MakeMeshDistance; inside is where the winding number exceeds 1/2: a
// closed body ends where its mesh does, an open one at a cap across each hole, a sheet has no
// inside. The turn of the polygons does not matter if it is the same for all. The cost goes with
// the area of mesh and caps.
openvdb::FloatGrid::Ptr MakeOpenMeshDistance(
  const MeshTriangles& mesh, double voxelSize, double band);

}

#endif
