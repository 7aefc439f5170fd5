// Triangles in the coordinates of a lattice [voxels], and the distances to them near by.

#ifndef LatticeMesh_h
#define LatticeMesh_h

#include "OpenVDB.h"
#include "SkinDistance.h"

#include <array>
#include <cstdint>
#include <vector>

namespace activesurface
{

struct LatticeMesh
{
  std::vector<openvdb::Vec3d> Points;
  std::vector<std::array<std::int64_t, 3>> Triangles;
};

// Up to HalfWidth on either side, which is the background too.
struct MeshBand
{
  openvdb::FloatGrid::Ptr Distances; // [voxels]; the transform is the identity
  openvdb::Int32Grid::Ptr Triangles; // number of the nearest triangle, where Distances is active
};

// Inside of what the triangles enclose: they have to be closed. By OpenVDB's own converter.
MeshBand MakeMeshBand(const LatticeMesh& mesh);

}

#endif
