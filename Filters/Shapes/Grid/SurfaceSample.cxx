#include "Grid/SurfaceSample.h"

#include "Input/MeshTriangles.h"

#include "vtkMath.h"

#include <cmath>

namespace activesurface
{

namespace
{

using Vector = std::array<double, 3>;

// Returns a normal whose length is twice the area.
Vector FindNormal(const MeshTriangles& mesh, const MeshTriangles::Triangle& triangle)
{
  Vector edge[2], normal;
  for (int i = 0; i < 2; ++i)
  {
    vtkMath::Subtract(
      mesh.Points[triangle[i + 1]].data(), mesh.Points[triangle[0]].data(), edge[i].data());
  }
  vtkMath::Cross(edge[0].data(), edge[1].data(), normal.data());
  return normal;
}

// Returns a point of a sequence that fills a triangle evenly: Roberts' sequence in the unit square,
// folded to the triangle.
Vector FindPlace(
  const MeshTriangles& mesh, const MeshTriangles::Triangle& triangle, std::size_t number)
{
  constexpr double plastic = 1.32471795724474602596; // x^3 = x + 1
  const auto part = [&](double step) { return std::fmod(0.5 + step * double(number + 1), 1.0); };
  double u = part(1.0 / plastic), v = part(1.0 / (plastic * plastic));
  if (u + v > 1.0)
  {
    u = 1.0 - u;
    v = 1.0 - v;
  }
  Vector place;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double a = mesh.Points[triangle[0]][axis];
    place[axis] =
      a + u * (mesh.Points[triangle[1]][axis] - a) + v * (mesh.Points[triangle[2]][axis] - a);
  }
  return place;
}

}

SurfaceSample SampleSurface(const MeshTriangles& mesh)
{
  double whole = 0.0;
  for (const MeshTriangles::Triangle& triangle : mesh.Triangles)
  {
    whole += 0.5 * vtkMath::Norm(FindNormal(mesh, triangle).data());
  }
  SurfaceSample surface;
  if (!(whole > 0.0) || !std::isfinite(whole))
  {
    return surface;
  }
  const double each = whole / static_cast<double>(SurfaceSample::Most);
  double area = 0.0; // of the triangles up to this one
  for (const MeshTriangles::Triangle& triangle : mesh.Triangles)
  {
    Vector normal = FindNormal(mesh, triangle);
    const double twice = vtkMath::Normalize(normal.data());
    area += 0.5 * twice;
    std::vector<SurfacePoint>& points = surface.Points;
    while (points.size() < SurfaceSample::Most &&
      (static_cast<double>(points.size()) + 0.5) * each < area)
    {
      points.push_back({ FindPlace(mesh, triangle, points.size()), normal, each });
    }
  }
  return surface;
}

void SurfaceGatherer::Add(const SurfacePoint& point)
{
  this->Points.push_back(point);
  if (this->Points.size() >= 2 * SurfaceSample::Most)
  {
    for (std::size_t i = 0; i < SurfaceSample::Most; ++i)
    {
      this->Points[i] = this->Points[2 * i];
    }
    this->Points.resize(SurfaceSample::Most);
    this->Stride *= 2;
  }
}

}
