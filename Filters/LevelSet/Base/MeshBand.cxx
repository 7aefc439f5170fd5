#include "Base/MeshBand.h"

#include "Base/OpenVDB.h"

#include <openvdb/tools/MeshToVolume.h>

namespace activesurface
{

namespace
{

/** Interface that meshToVolume requires. */
struct VoxelMesh
{
  const LatticeTriangles& Mesh;

  // NOLINTBEGIN(readability-identifier-naming)
  std::size_t polygonCount() const { return this->Mesh.GetNumberOfTriangles(); }
  std::size_t pointCount() const { return this->Mesh.GetNumberOfPoints(); }
  std::size_t vertexCount(std::size_t) const { return 3; }
  void getIndexSpacePoint(std::size_t triangle, std::size_t corner, openvdb::Vec3d& place) const
  {
    place = this->Mesh.GetCorner(triangle, corner);
  }
  // NOLINTEND(readability-identifier-naming)
};

}

LatticeTriangles::~LatticeTriangles() = default;

MeshBand MakeMeshBand(const LatticeTriangles& mesh, float halfWidth, bool isSigned)
{
  // Renormalisation is disabled: it is meant for meshes that intersect themselves, and would move
  // the surface by up to a voxel at concave edges.
  const int flags = openvdb::tools::DISABLE_RENORMALIZATION |
    (isSigned ? 0 : openvdb::tools::UNSIGNED_DISTANCE_FIELD);
  MeshBand band;
  band.Triangles = openvdb::Int32Grid::create(openvdb::Int32(MeshBand::NoTriangle));
  band.Distances = openvdb::tools::meshToVolume<openvdb::FloatGrid>(VoxelMesh{ mesh },
    openvdb::math::Transform(), halfWidth, halfWidth, flags, band.Triangles.get());
  return band;
}

}
