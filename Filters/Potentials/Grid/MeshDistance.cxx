#include "Grid/MeshDistance.h"

#include "MeshTriangles.h"
#include "OpenVDB.h"

#include <openvdb/math/Proximity.h>
#include <openvdb/tools/MeshToVolume.h>
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

// What meshToVolume asks for.
class VoxelMesh
{
public:
  VoxelMesh(const MeshTriangles& mesh, double voxelSize)
    : Mesh(mesh)
    , VoxelSize(voxelSize)
  {
  }

  // NOLINTBEGIN(readability-identifier-naming)
  std::size_t polygonCount() const { return this->Mesh.Triangles.size(); }
  std::size_t pointCount() const { return this->Mesh.Points.size(); }
  std::size_t vertexCount(std::size_t) const { return 3; }
  void getIndexSpacePoint(std::size_t triangle, std::size_t corner, openvdb::Vec3d& place) const
  {
    const MeshTriangles::Point& point = this->Mesh.Points[this->Mesh.Triangles[triangle][corner]];
    for (int axis = 0; axis < 3; ++axis)
    {
      place[axis] = point[axis] / this->VoxelSize;
    }
  }
  // NOLINTEND(readability-identifier-naming)

private:
  const MeshTriangles& Mesh;
  const double VoxelSize;
};

// Goes over a mesh from a triangle to those that share a point with it.
class Walk
{
public:
  Walk(const MeshTriangles& mesh, const VoxelMesh& voxels);

  // The square of the distance to the last triangle of a walk that gets nearer with each step.
  double FindSquare(const openvdb::Vec3d& place, std::size_t triangle) const;

private:
  double SquareTo(const openvdb::Vec3d& place, std::size_t triangle) const;

  const MeshTriangles& Mesh;
  const VoxelMesh& Voxels;
  std::vector<std::size_t> First; // of each point, in Around
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
  openvdb::Vec3d a, b, c, weights;
  this->Voxels.getIndexSpacePoint(triangle, 0, a);
  this->Voxels.getIndexSpacePoint(triangle, 1, b);
  this->Voxels.getIndexSpacePoint(triangle, 2, c);
  return (openvdb::math::closestPointOnTriangleToPoint(a, b, c, place, weights) - place)
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

// Near the mesh, OpenVDB's distances are exact, and the walls between bodies that overlap are taken
// out. They are still in the mesh: a walk that gets much nearer has found one, and does not count.
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
    if (known > exact && triangle != openvdb::Int32(openvdb::util::INVALID_IDX))
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
  // Without renormalisation: it is meant for meshes that intersect themselves, and moves distances.
  const int flags = openvdb::tools::DISABLE_RENORMALIZATION |
    (lattice.IsSigned ? 0 : openvdb::tools::UNSIGNED_DISTANCE_FIELD);
  const auto band = static_cast<float>(lattice.Band);
  openvdb::Int32Grid nearest(static_cast<openvdb::Int32>(openvdb::util::INVALID_IDX));
  openvdb::FloatGrid::Ptr distance = openvdb::tools::meshToVolume<openvdb::FloatGrid>(
    voxels, openvdb::math::Transform(), band, band, flags, &nearest);

  const Walk walk(mesh, voxels);
  std::vector<openvdb::FloatTree::LeafNodeType*> leaves;
  distance->tree().getNodes(leaves);
  tbb::parallel_for(std::size_t(0), leaves.size(),
    [&](std::size_t i) { Shorten(*leaves[i], nearest.tree(), walk); });
  return distance;
}

}
