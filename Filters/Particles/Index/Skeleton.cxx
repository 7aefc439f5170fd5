#include "Index/Skeleton.h"

#include <algorithm>
#include <cmath>

namespace activesurface
{
namespace
{
constexpr double SmallestSize = 1e-100;
constexpr double LargestSize = 1e100;
}

bool SkeletonVertex::IsUsable() const
{
  return std::fabs(this->Position[0]) <= LargestSize &&
    std::fabs(this->Position[1]) <= LargestSize && std::fabs(this->Position[2]) <= LargestSize &&
    this->Radius >= SmallestSize && this->Radius <= LargestSize &&
    std::fabs(this->Strength) <= LargestSize;
}

void Skeleton::Clear()
{
  this->Points.clear();
  this->Segments.clear();
  this->Near.Clear();
}

void Skeleton::AddPoint(const SkeletonVertex& vertex)
{
  const double* p = vertex.Position;
  this->Points.push_back(
    { { p[0], p[1], p[2] }, vertex.Strength, 1.0 / (vertex.Radius * vertex.Radius) });
  this->Near.AddBall(p, vertex.Radius);
}

void Skeleton::AddSegment(const SkeletonVertex& start, const SkeletonVertex& end)
{
  SkeletonSegment segment;
  double length2 = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    segment.Start[axis] = start.Position[axis];
    segment.Edge[axis] = end.Position[axis] - start.Position[axis];
    length2 += segment.Edge[axis] * segment.Edge[axis];
  }
  const bool hasLength = length2 >= SmallestSize * SmallestSize;
  segment.InverseLength2 = hasLength ? 1.0 / length2 : 0.0;
  segment.Radius = start.Radius;
  segment.RadiusChange = end.Radius - start.Radius;
  segment.Strength = start.Strength;
  segment.StrengthChange = end.Strength - start.Strength;
  this->Segments.push_back(segment);
  const double *a = start.Position, *b = end.Position;
  this->Near.Add({ { a[0], a[1], a[2] }, { b[0], b[1], b[2] }, start.Radius, end.Radius });
}

std::vector<SkeletonVertex> Skeleton::ListPoints() const
{
  std::vector<SkeletonVertex> vertices(this->Points.size());
  for (std::size_t i = 0; i < vertices.size(); ++i)
  {
    std::copy_n(this->Points[i].Position, 3, vertices[i].Position);
    vertices[i].Radius = this->Near[i].StartRadius;
    vertices[i].Strength = this->Points[i].Strength;
  }
  return vertices;
}

namespace
{

double ValueOf(SkeletonKernel kernel, double q2)
{
  switch (kernel)
  {
    case SkeletonKernel::CubicSpline:
      return CubicSplineKernel::At(q2).Value;
    case SkeletonKernel::Metaball:
      return MetaballKernel::At(q2).Value;
    case SkeletonKernel::Wyvill:
      break;
  }
  return WyvillKernel::At(q2).Value;
}

}

double FindRadiusOfLevel(SkeletonKernel kernel, double level)
{
  double near = 0.0, far = 1.0;
  constexpr int halvings = 52;
  for (int i = 0; i < halvings; ++i)
  {
    const double q = 0.5 * (near + far);
    (ValueOf(kernel, q * q) > level ? near : far) = q;
  }
  return 0.5 * (near + far);
}

}
