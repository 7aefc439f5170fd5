#include "Grid/MeshVoxels.h"

#include "Base/OpenVDB.h"
#include "Input/MeshTriangles.h"

#include <openvdb/tree/ValueAccessor.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace activesurface
{

namespace
{

// Corners of a triangle, in units of a cube's edge.
using Corners = std::array<openvdb::Vec3d, 3>;

// Counts the cubes that triangles cross, up to a maximum.
class Cubes
{
public:
  explicit Cubes(double maximum)
    : Maximum(maximum)
    , Passed(this->Tree)
  {
  }

  // Samples the triangle in rows from its longest edge to the other two edges.
  void Add(const Corners& triangle);

  bool AreTooMany() const { return this->Count > this->Maximum; }
  double GetCount() const { return this->Count; }

private:
  void AddRow(const openvdb::Vec3d& from, const openvdb::Vec3d& to);

  const double Maximum;
  double Count = 0.0;
  openvdb::MaskTree Tree;
  openvdb::tree::ValueAccessor<openvdb::MaskTree> Passed;
};

// Returns the number of equal parts of a length, each at most half a cube's edge long.
double CountParts(double length)
{
  return std::max(std::ceil(2.0 * length), 1.0);
}

void Cubes::AddRow(const openvdb::Vec3d& from, const openvdb::Vec3d& to)
{
  const double count = CountParts((to - from).length());
  for (double i = 0.5; i < count && !this->AreTooMany(); i += 1.0)
  {
    const openvdb::Coord cube = openvdb::Coord::floor(from + i / count * (to - from));
    if (!this->Passed.isValueOn(cube))
    {
      this->Passed.setValueOn(cube);
      this->Count += 1.0;
    }
  }
}

std::size_t FindLongestEdge(const Corners& triangle)
{
  std::size_t first = 0;
  double longest = 0.0;
  for (std::size_t corner = 0; corner < 3; ++corner)
  {
    const double square = (triangle[(corner + 1) % 3] - triangle[corner]).lengthSqr();
    first = square > longest ? corner : first;
    longest = std::max(longest, square);
  }
  return first;
}

void Cubes::Add(const Corners& triangle)
{
  const std::size_t first = FindLongestEdge(triangle);
  const openvdb::Vec3d &a = triangle[first], &b = triangle[(first + 1) % 3],
                       &c = triangle[(first + 2) % 3];
  const openvdb::Vec3d edge = b - a;
  const double square = edge.lengthSqr();
  const double foot = square > 0.0 ? (c - a).dot(edge) / square : 0.5; // c's projection on the edge
  const double count = CountParts(std::sqrt(square));
  for (double i = 0.5; i < count && !this->AreTooMany(); i += 1.0)
  {
    const double along = i / count;
    this->AddRow(a + along * edge,
      along < foot ? a + along / foot * (c - a) : b + (1.0 - along) / (1.0 - foot) * (c - b));
  }
}

double CountVoxelsOfBox(const MeshTriangles& mesh, double voxelSize, double band)
{
  const std::array<double, 6> bounds = mesh.GetBounds();
  double voxels = 1.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    voxels *= (bounds[2 * axis + 1] - bounds[2 * axis]) / voxelSize + 2.0 * band;
  }
  return voxels;
}

}

double EstimateVoxelsNear(const MeshTriangles& mesh, double voxelSize, double band, double maximum)
{
  const double box = CountVoxelsOfBox(mesh, voxelSize, band);
  const double edge = 2.0 * band;
  const double voxelsPerCube = edge * edge * edge;
  if (box <= maximum || !std::isfinite(voxelsPerCube))
  {
    return box;
  }
  Cubes cubes(maximum / voxelsPerCube);
  for (const MeshTriangles::Triangle& triangle : mesh.Triangles)
  {
    Corners corners;
    for (std::size_t corner = 0; corner < 3; ++corner)
    {
      corners[corner] = openvdb::Vec3d(mesh.Points[triangle[corner]].data()) / (voxelSize * edge);
    }
    cubes.Add(corners);
    if (cubes.AreTooMany())
    {
      break;
    }
  }
  return std::min(box, cubes.GetCount() * voxelsPerCube);
}

}
