#include "ThinParts.h"

#include "GridSamples.h"
#include "MeshTriangles.h"

#include "vtkMath.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace activesurface
{

namespace
{

using Vector = std::array<double, 3>;

// Twice the area, along the normal.
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

// The i-th place of a sequence that fills a triangle evenly: of Roberts' in the unit square, which
// is folded.
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

// Places along a normal.
struct Way
{
  double Step;
  int Count;
};

Way MakeWay(const SurfaceSample& surface, double thickness)
{
  constexpr double within = 0.99; // what is just as thick is not thin, however samples are rounded
  constexpr double part = 0.25;   // of the detail, so that its slopes are met
  constexpr double mostSteps = 256.0;
  const double length = (surface.IsMiddle ? 0.5 : 1.0) * within * thickness;
  const double step = part * std::min(thickness, surface.Detail);
  const double count = std::min(std::ceil(length / step), mostSteps);
  return { length / count, static_cast<int>(count) };
}

// Whether the function is positive, and rises along the way, anywhere on it.
bool LeadsOut(const GridSamples& function, const SurfacePoint& from, double sense, const Way& way)
{
  constexpr double steepest = 0.70710678118654752440; // the cosine of 45 degrees
  for (int i = 1; i <= way.Count; ++i)
  {
    double x[3], gradient[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      x[axis] = from.Place[axis] + sense * (i * way.Step) * from.Normal[axis];
    }
    const double value = function.Evaluate(x, gradient);
    const double rise = sense * vtkMath::Dot(gradient, from.Normal.data());
    if (value > 0.0 && rise > 0.0 && rise >= steepest * vtkMath::Norm(gradient))
    {
      return true;
    }
  }
  return false;
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
  double area = 0.0; // of the triangles so far
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

double FindThinShare(const GridSamples& function, const SurfaceSample& surface, double thickness)
{
  const Way way = MakeWay(surface, thickness);
  const std::vector<SurfacePoint>& points = surface.Points;
  std::vector<char> isThin(points.size());
  constexpr std::size_t grain = 64;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), grain),
    [&](const tbb::blocked_range<std::size_t>& range)
    {
      for (std::size_t i = range.begin(); i != range.end(); ++i)
      {
        isThin[i] =
          LeadsOut(function, points[i], 1.0, way) && LeadsOut(function, points[i], -1.0, way);
      }
    });
  double whole = 0.0, thin = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    whole += points[i].Area;
    thin += isThin[i] ? points[i].Area : 0.0;
  }
  return whole > 0.0 ? thin / whole : 0.0;
}

}
