// Estimates the number of voxels near a mesh.

#ifndef MeshVoxels_h
#define MeshVoxels_h

namespace activesurface
{

struct MeshTriangles;

// Returns the approximate number of voxels within `band` voxels of the mesh. Allocates no memory
// for voxels. Stops beyond the maximum and then returns a larger number than the maximum.
//
// The mesh's box, enlarged by the band, is an upper bound. If this bound exceeds the maximum,
// counts the cubes that the mesh crosses; the side of a cube is twice the band. The estimate is
// accurate for a flat mesh parallel to two axes, else within a factor of about two.
double EstimateVoxelsNear(const MeshTriangles& mesh, double voxelSize, double band, double maximum);

}

#endif
