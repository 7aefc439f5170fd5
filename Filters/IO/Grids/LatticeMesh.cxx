#include "Grids/LatticeMesh.h"

#include "OpenVDB.h"

#include <openvdb/tools/MeshToVolume.h>

namespace activesurface
{

namespace
{

// As openvdb::tools::meshToVolume wants it.
class Adapter
{
public:
  explicit Adapter(const LatticeMesh& mesh)
    : Mesh(mesh)
  {
  }
  // NOLINTBEGIN(readability-identifier-naming)
  std::size_t polygonCount() const { return this->Mesh.Triangles.size(); }
  std::size_t pointCount() const { return this->Mesh.Points.size(); }
  std::size_t vertexCount(std::size_t) const { return 3; }
  void getIndexSpacePoint(std::size_t triangle, std::size_t corner, openvdb::Vec3d& point) const
  {
    point = this->Mesh.Points[this->Mesh.Triangles[triangle][corner]];
  }
  // NOLINTEND(readability-identifier-naming)

private:
  const LatticeMesh& Mesh;
};

}

MeshBand MakeMeshBand(const LatticeMesh& mesh)
{
  MeshBand band;
  band.Triangles = openvdb::Int32Grid::create(-1);
  // Renormalisation moves the surface at concave edges, by up to a voxel.
  const auto identity = openvdb::math::Transform::createLinearTransform(1.0);
  band.Distances = openvdb::tools::meshToVolume<openvdb::FloatGrid>(Adapter(mesh), *identity,
    HalfWidth, HalfWidth, openvdb::tools::DISABLE_RENORMALIZATION, band.Triangles.get());
  return band;
}

}
