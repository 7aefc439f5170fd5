// Computes distances from lattice nodes to the triangles of a NarrowBand's skin.
//
// The potential provides only the sign, because the potential is no exact distance. The search for
// a node starts at the nearest triangles of the neighbour nodes in earlier layers or, in the first
// layer, at the triangles in the eight voxels around the node. The search moves to closer triangles
// around the closest point until no triangle is closer. Each layer of nodes depends only on earlier
// layers, so the result does not depend on the number of threads.
//
// OpenVDB's conversion of meshes, corrected by the walk of MeshDistance.h, would need twice the
// time, and near medial axes would return distances up to half a voxel too long.

#ifndef SkinBand_h
#define SkinBand_h

#include "Base/MeshBand.h"
#include "Surface/SkinDistance.h"

#include <array>
#include <cstdint>
#include <vector>

namespace activesurface
{

class NarrowBand;

// Triangle mesh in lattice coordinates [voxels].
struct LatticeMesh : LatticeTriangles
{
  std::vector<openvdb::Vec3d> Points;
  std::vector<std::array<std::int64_t, 3>> Triangles;

  std::size_t GetNumberOfPoints() const override { return this->Points.size(); }
  std::size_t GetNumberOfTriangles() const override { return this->Triangles.size(); }
  openvdb::Vec3d GetCorner(std::size_t triangle, std::size_t corner) const override
  {
    return this->Points[this->Triangles[triangle][corner]];
  }
};

// Returns the skin in the coordinates of the band's lattice.
LatticeMesh MakeSkinMesh(const NarrowBand& band);

// Returns the distances [voxels] and the nearest triangles at the nodes within HalfWidth of the
// skin. mesh: the result of MakeSkinMesh for this band.
MeshBand MakeSkinBand(const NarrowBand& band, const LatticeMesh& mesh);

}

#endif
