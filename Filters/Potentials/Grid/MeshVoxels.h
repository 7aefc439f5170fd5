// How many voxels are near a mesh.

#ifndef MeshVoxels_h
#define MeshVoxels_h

namespace activesurface
{

struct MeshTriangles;

// About the number of voxels within `band` voxels of the mesh, which takes memory for none of them.
// Stops counting beyond the maximum, and then returns more than that.
//
// They are not more than the mesh's box has, with the band around it. Where that is too many, space
// is divided into cubes of twice the band, and those that the mesh passes are counted: a flat mesh
// along two axes passes as many as hold the voxels near it, and so does a line along an axis; in
// other directions both pass up to one and a half times as many.
double EstimateVoxelsNear(const MeshTriangles& mesh, double voxelSize, double band, double maximum);

}

#endif
