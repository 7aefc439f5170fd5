#include "Grid/MeshDistance.h"

#include "Base/MeshBand.h"
#include "Base/OpenVDB.h"
#include "Input/MeshTriangles.h"

#include <openvdb/math/Proximity.h>
#include <openvdb/tree/ValueAccessor.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace activesurface
{

namespace
{

class VoxelMesh : public LatticeTriangles
{
public:
  VoxelMesh(const MeshTriangles& mesh, double voxelSize)
    : Mesh(mesh)
    , VoxelSize(voxelSize)
  {
  }

  std::size_t GetNumberOfPoints() const final { return this->Mesh.Points.size(); }
  std::size_t GetNumberOfTriangles() const final { return this->Mesh.Triangles.size(); }
  openvdb::Vec3d GetCorner(std::size_t triangle, std::size_t corner) const final
  {
    const MeshTriangles::Point& point = this->Mesh.Points[this->Mesh.Triangles[triangle][corner]];
    return { point[0] / this->VoxelSize, point[1] / this->VoxelSize, point[2] / this->VoxelSize };
  }

private:
  const MeshTriangles& Mesh;
  const double VoxelSize;
};

// Walks over a mesh from a triangle to triangles that share a point with it.
class Walk
{
public:
  Walk(const MeshTriangles& mesh, const VoxelMesh& voxels);

  // Walks from `triangle` as long as each step decreases the distance to `place`. Returns the
  // squared distance between `place` and the last triangle [voxels^2].
  double FindSquare(const openvdb::Vec3d& place, std::size_t triangle) const;

private:
  double SquareTo(const openvdb::Vec3d& place, std::size_t triangle) const;

  const MeshTriangles& Mesh;
  const VoxelMesh& Voxels;
  std::vector<std::size_t> First; // index into Around, by point
  std::vector<std::size_t> Around;
};

Walk::Walk(const MeshTriangles& mesh, const VoxelMesh& voxels)
  : Mesh(mesh)
  , Voxels(voxels)
  , First(mesh.Points.size() + 1, 0)
  , Around(3 * mesh.Triangles.size())
{
  for (const MeshTriangles::Triangle& triangle : mesh.Triangles)
  {
    for (const vtkIdType corner : triangle)
    {
      ++this->First[corner];
    }
  }
  for (std::size_t i = 1; i < this->First.size(); ++i)
  {
    this->First[i] += this->First[i - 1];
  }
  for (std::size_t i = mesh.Triangles.size(); i-- > 0;)
  {
    for (const vtkIdType corner : mesh.Triangles[i])
    {
      this->Around[--this->First[corner]] = i;
    }
  }
}

double Walk::SquareTo(const openvdb::Vec3d& place, std::size_t triangle) const
{
  openvdb::Vec3d weights;
  return (
    openvdb::math::closestPointOnTriangleToPoint(this->Voxels.GetCorner(triangle, 0),
      this->Voxels.GetCorner(triangle, 1), this->Voxels.GetCorner(triangle, 2), place, weights) -
    place)
    .lengthSqr();
}

double Walk::FindSquare(const openvdb::Vec3d& place, std::size_t triangle) const
{
  double least = this->SquareTo(place, triangle);
  for (std::size_t from = this->Mesh.Triangles.size(); from != triangle;)
  {
    from = triangle;
    for (const vtkIdType corner : this->Mesh.Triangles[from])
    {
      for (std::size_t i = this->First[corner]; i < this->First[corner + 1]; ++i)
      {
        const double square = this->SquareTo(place, this->Around[i]);
        if (square < least)
        {
          least = square;
          triangle = this->Around[i];
        }
      }
    }
  }
  return least;
}

// Corrects distances beyond `exact` voxels by a walk; shorter distances are exact. OpenVDB ignores
// walls inside overlapping bodies, but the mesh still contains these walls. If a walk shortens the
// distance by a voxel or more, it has found such a wall and is ignored.
void Shorten(
  openvdb::FloatTree::LeafNodeType& leaf, const openvdb::Int32Tree& nearest, const Walk& walk)
{
  constexpr float exact = .75f;
  constexpr float mostTooLong = 1.f;
  const openvdb::tree::ValueAccessor<const openvdb::Int32Tree, false> triangles(nearest);
  for (auto node = leaf.beginValueOn(); node; ++node)
  {
    const openvdb::Coord place = node.getCoord();
    const openvdb::Int32 triangle = triangles.getValue(place);
    const float known = std::fabs(*node);
    if (known > exact && triangle != MeshBand::NoTriangle)
    {
      const auto distance = static_cast<float>(
        std::sqrt(walk.FindSquare(place.asVec3d(), static_cast<std::size_t>(triangle))));
      if (distance < known && distance > known - mostTooLong)
      {
        node.setValue(std::copysign(distance, *node));
      }
    }
  }
}

}

openvdb::FloatGrid::Ptr MakeMeshDistance(const MeshTriangles& mesh, const MeshLattice& lattice)
{
  const VoxelMesh voxels(mesh, lattice.VoxelSize);
  const MeshBand band = MakeMeshBand(voxels, static_cast<float>(lattice.Band), lattice.IsSigned);

  const Walk walk(mesh, voxels);
  std::vector<openvdb::FloatTree::LeafNodeType*> leaves;
  band.Distances->tree().getNodes(leaves);
  tbb::parallel_for(std::size_t(0), leaves.size(),
    [&](std::size_t i) { Shorten(*leaves[i], band.Triangles->tree(), walk); });
  return band.Distances;
}

}
