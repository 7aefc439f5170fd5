#include "Skeleton.h"

#include <algorithm>
#include <cmath>

namespace activesurface
{
namespace
{
// Of the radius: more means more that is looked at in vain, less means more builds.
constexpr double MarginOfMoving = 0.1;

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
  this->Capsules.clear();
}

void Skeleton::AddPoint(const SkeletonVertex& vertex)
{
  const double* p = vertex.Position;
  this->Points.push_back(
    { { p[0], p[1], p[2] }, vertex.Strength, 1.0 / (vertex.Radius * vertex.Radius) });
  this->AddCapsule(vertex, vertex);
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
  this->AddCapsule(start, end);
}

void Skeleton::AddCapsule(const SkeletonVertex& start, const SkeletonVertex& end)
{
  const bool isFirst = this->Capsules.empty();
  Capsule capsule;
  for (int axis = 0; axis < 3; ++axis)
  {
    capsule.Start[axis] = start.Position[axis];
    capsule.End[axis] = end.Position[axis];
    const double low =
      std::min(start.Position[axis] - start.Radius, end.Position[axis] - end.Radius);
    const double high =
      std::max(start.Position[axis] + start.Radius, end.Position[axis] + end.Radius);
    double* bounds = this->Bounds + 2 * axis;
    bounds[0] = isFirst ? low : std::min(bounds[0], low);
    bounds[1] = isFirst ? high : std::max(bounds[1], high);
  }
  capsule.StartRadius = start.Radius;
  capsule.EndRadius = end.Radius;
  this->Capsules.push_back(capsule);
}

// Whether each element lies within what the cells list for it.
bool Skeleton::AreWithinCells() const
{
  constexpr double largest = 1.0 + 2.0 * MarginOfMoving; // then cells list too much
  const auto isWithin = [](const double at[3], double radius, const double centre[3], double reach)
  {
    const double x = at[0] - centre[0], y = at[1] - centre[1], z = at[2] - centre[2];
    const double room = reach - radius;
    return room >= 0.0 && reach <= largest * radius && x * x + y * y + z * z <= room * room;
  };
  // What holds at both ends of a segment holds between them: all runs linearly.
  return this->Listed.size() == this->Capsules.size() &&
    std::equal(this->Capsules.begin(), this->Capsules.end(), this->Listed.begin(),
      [&](const Capsule& now, const Capsule& then)
      {
        return isWithin(now.Start, now.StartRadius, then.Start, then.StartRadius) &&
          isWithin(now.End, now.EndRadius, then.End, then.EndRadius);
      });
}

void Skeleton::Build()
{
  if (this->AreWithinCells())
  {
    return;
  }
  const bool moves = this->Listed.size() == this->Capsules.size();
  const double factor = moves ? 1.0 + MarginOfMoving : 1.0;
  double largest = 0.0;
  this->Listed = this->Capsules;
  for (Capsule& capsule : this->Listed)
  {
    largest = std::max({ largest, capsule.StartRadius, capsule.EndRadius });
    capsule.StartRadius *= factor;
    capsule.EndRadius *= factor;
  }
  double bounds[6];
  for (int side = 0; side < 6; ++side)
  {
    bounds[side] = this->Bounds[side] + (side % 2 ? 1.0 : -1.0) * (factor - 1.0) * largest;
  }
  try
  {
    this->Cells.Build(this->Listed, bounds);
  }
  catch (...)
  {
    this->Listed.clear();
    this->Cells = SkeletonCells(); // what is half built lists elements that are not there
    throw;
  }
}

}
