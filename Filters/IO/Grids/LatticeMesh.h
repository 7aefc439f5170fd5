// Triangle mesh in lattice coordinates [voxels].

#ifndef LatticeMesh_h
#define LatticeMesh_h

#include "MeshBand.h"
#include "SkinDistance.h"

#include <array>
#include <cstdint>
#include <vector>

namespace activesurface
{

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

}

#endif
