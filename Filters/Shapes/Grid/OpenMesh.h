// Finds the inside of a mesh with holes by generalized winding numbers.

#ifndef OpenMesh_h
#define OpenMesh_h

#include "Grid/MeshDistance.h"

namespace activesurface
{

// Returns a signed distance like MakeMeshDistance. A node is inside if its winding number exceeds
// 0.51 (1/2 plus the numerical error) in magnitude. The inside of a body ends at the mesh and, if
// the body is open, at a cap across each hole. A sheet has no inside. The polygons may all face
// outward, or all inward. The cost is proportional to the area of mesh and caps.
openvdb::FloatGrid::Ptr MakeOpenMeshDistance(
  const MeshTriangles& mesh, double voxelSize, double band);

}

#endif
