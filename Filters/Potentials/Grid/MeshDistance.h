// Distances to a mesh on the nodes of a lattice near it.

#ifndef MeshDistance_h
#define MeshDistance_h

#include "OpenVDB.h"

namespace activesurface
{

struct MeshTriangles;

struct MeshLattice
{
  double VoxelSize = 1.0;
  double Band = 3.0;    // voxels: how far from the mesh distances are kept
  bool IsSigned = true; // negative inside
};

// Distances in voxels; nodes (i, j, k) are at (i, j, k) * VoxelSize, and the grid's own transform
// is the identity, as OpenVDB's refuses small voxels. Beyond the band: + or - Band.
//
// OpenVDB's conversion, whose distances away from the mesh are those to a triangle that is the
// closest one of a neighbour: up to half a voxel too long where triangles are small. From there, a
// walk over the mesh, from triangle to nearer triangle, finds the closest one.
openvdb::FloatGrid::Ptr MakeMeshDistance(const MeshTriangles& mesh, const MeshLattice& lattice);

}

#endif
