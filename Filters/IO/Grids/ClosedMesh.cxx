#include "Grids/ClosedMesh.h"

#include "LatticeOrigin.h"
#include "MeshTriangles.h"

#include "vtkPolyData.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace activesurface
{

namespace
{

constexpr double VoxelsAcross = 64.0;

void CheckIsClosed(const MeshTriangles& mesh)
{
  if (mesh.Defects.BrokenPolygons > 0)
  {
    throw std::invalid_argument(mesh.Defects.Describe() + " Mend it before it is written.");
  }
  if (mesh.Triangles.empty())
  {
    throw std::invalid_argument("The input has no polygons: there is no surface to write.");
  }
  if (!mesh.Defects.IsClosed())
  {
    throw std::invalid_argument(
      "The mesh is not closed, so it has no inside: " + std::to_string(mesh.Defects.OddEdges) +
      " of its edges belong to one polygon only, or to another odd number of them. Close it first "
      "(vtkFillHolesFilter), or let a vtkActiveImplicitSurface make a shell of it "
      "(MeshThickness).");
  }
}

double FindLongestSide(const MeshTriangles& mesh)
{
  const std::array<double, 6> bounds = mesh.GetBounds();
  return std::max({ bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4] });
}

}

LatticeMesh ReadClosedMesh(vtkPolyData* data, double& voxelSize, std::array<double, 3>& origin)
{
  const MeshTriangles read = ReadTriangles(data);
  CheckIsClosed(read);
  const double side = FindLongestSide(read);
  voxelSize = voxelSize > 0.0 ? voxelSize : side / VoxelsAcross;
  constexpr double mostVoxels = 1 << 20;
  if (!(side / voxelSize <= mostVoxels))
  {
    throw std::invalid_argument("The mesh is more than a million voxels long; enlarge VoxelSize.");
  }
  const std::array<double, 6> bounds = read.GetBounds();
  for (int axis = 0; axis < 3; ++axis)
  {
    origin[axis] = FindLatticeOrigin(bounds[2 * axis], bounds[2 * axis + 1], voxelSize);
  }
  LatticeMesh mesh;
  const openvdb::Vec3d offset(origin.data());
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    mesh.Points.push_back((openvdb::Vec3d(data->GetPoint(i)) - offset) / voxelSize);
  }
  for (const MeshTriangles::Triangle& corners : read.Origins)
  {
    mesh.Triangles.push_back({ corners[0], corners[1], corners[2] });
  }
  return mesh;
}

}
