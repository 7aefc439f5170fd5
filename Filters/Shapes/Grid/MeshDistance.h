// Computes distances to a mesh at lattice nodes near the mesh.

#ifndef MeshDistance_h
#define MeshDistance_h

#include "Base/OpenVDB.h"

namespace activesurface
{

struct MeshTriangles;

struct MeshLattice
{
  double VoxelSize = 1.0;
  double Band = 3.0;    // largest distance that is computed [voxels]
  bool IsSigned = true; // negative inside
};

// Returns distances in voxels. Node (i, j, k) is at (i, j, k) * VoxelSize. The grid's own transform
// is the identity, because OpenVDB rejects small voxels. Beyond the band, values are Band, or -Band
// inside with IsSigned.
//
// OpenVDB's conversion propagates the closest triangle from node to node. If triangles are small,
// these distances are up to half a voxel too long. The conversion is therefore followed by a walk
// over the mesh, from triangle to nearer triangle, as long as the distance decreases. A walk may
// end too early: over a sphere, distances at one node in a thousand are 0.1 to 0.6 voxels too long.
openvdb::FloatGrid::Ptr MakeMeshDistance(const MeshTriangles& mesh, const MeshLattice& lattice);

}

#endif
