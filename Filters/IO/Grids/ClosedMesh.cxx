#include "Grids/ClosedMesh.h"

#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace activesurface
{

namespace
{

constexpr double VoxelsAcross = 64.0;

using Triangle = std::array<std::int64_t, 3>;

// Calls add(count, points) for each cell.
template <class Add>
void ForEachCell(vtkCellArray* cells, Add&& add)
{
  const auto cell = vtk::TakeSmartPointer(cells->NewIterator());
  for (cell->GoToFirstCell(); !cell->IsDoneWithTraversal(); cell->GoToNextCell())
  {
    vtkIdType count;
    const vtkIdType* points;
    cell->GetCurrentCell(count, points);
    add(count, points);
  }
}

std::vector<Triangle> ReadTriangles(vtkPolyData* data)
{
  std::vector<Triangle> triangles;
  ForEachCell(data->GetPolys(),
    [&](vtkIdType count, const vtkIdType* p)
    {
      for (vtkIdType i = 2; i < count; ++i)
      {
        triangles.push_back({ p[0], p[i - 1], p[i] });
      }
    });
  ForEachCell(data->GetStrips(),
    [&](vtkIdType count, const vtkIdType* p)
    {
      for (vtkIdType i = 2; i < count; ++i)
      {
        const vtkIdType turn = i % 2;
        triangles.push_back({ p[i - 2], p[i - 1 + turn], p[i - turn] });
      }
    });
  return triangles;
}

// For each point the first one of its coordinates.
std::vector<std::int64_t> FindFirstEqual(const std::vector<openvdb::Vec3d>& points)
{
  std::vector<std::int64_t> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
    [&](std::int64_t a, std::int64_t b)
    { return points[a] < points[b] || (points[a] == points[b] && a < b); });
  std::vector<std::int64_t> first(points.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    const bool isNew = i == 0 || points[order[i]] != points[order[i - 1]];
    first[order[i]] = isNew ? order[i] : first[order[i - 1]];
  }
  return first;
}

void CheckIsClosed(const LatticeMesh& mesh)
{
  const std::vector<std::int64_t> first = FindFirstEqual(mesh.Points);
  std::vector<std::pair<std::int64_t, std::int64_t>> edges;
  for (const Triangle& t : mesh.Triangles)
  {
    const std::int64_t corner[3] = { first[t[0]], first[t[1]], first[t[2]] };
    const bool isFlat = corner[0] == corner[1] || corner[1] == corner[2] || corner[2] == corner[0];
    for (int i = 0; !isFlat && i < 3; ++i)
    {
      edges.push_back(std::minmax({ corner[i], corner[(i + 1) % 3] }));
    }
  }
  std::sort(edges.begin(), edges.end());
  std::size_t open = 0;
  for (auto edge = edges.begin(); edge != edges.end();)
  {
    const auto end = std::upper_bound(edge, edges.end(), *edge);
    open += (end - edge) % 2;
    edge = end;
  }
  if (open > 0 || edges.empty())
  {
    throw std::invalid_argument(edges.empty()
        ? "The input has no polygons: there is no surface to write."
        : "The mesh is not closed, so it has no inside: " + std::to_string(open) +
          " of its edges belong to one polygon only. Close it first (vtkFillHolesFilter), or let a "
          "vtkActiveImplicitSurface make a shell of it (MeshThickness).");
  }
}

}

LatticeMesh ReadClosedMesh(vtkPolyData* data, double& voxelSize)
{
  double bounds[6];
  data->GetCellsBounds(bounds);
  const double side =
    std::max({ bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4] });
  voxelSize = voxelSize > 0.0 ? voxelSize : side / VoxelsAcross;
  constexpr double mostVoxels = 1 << 20;
  LatticeMesh mesh;
  mesh.Triangles = ReadTriangles(data);
  for (vtkIdType i = 0; i < data->GetNumberOfPoints(); ++i)
  {
    const openvdb::Vec3d point(data->GetPoint(i));
    if (!point.isFinite())
    {
      throw std::invalid_argument("A point of the mesh is not finite.");
    }
    mesh.Points.push_back(point / (voxelSize > 0.0 ? voxelSize : 1.0));
  }
  CheckIsClosed(mesh);
  if (!(side / voxelSize <= mostVoxels))
  {
    throw std::invalid_argument("The mesh is more than a million voxels long; enlarge VoxelSize.");
  }
  return mesh;
}

}
