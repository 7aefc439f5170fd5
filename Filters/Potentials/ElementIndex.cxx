#include "ElementIndex.h"

#include <algorithm>

namespace activesurface
{
namespace
{
// Safety margin as a fraction of the radius: larger gives more false candidates, smaller more
// rebuilds.
constexpr double MarginOfMoving = 0.1;
}

void ElementIndex::AddBall(const double centre[3], double radius)
{
  this->Add(
    { { centre[0], centre[1], centre[2] }, { centre[0], centre[1], centre[2] }, radius, radius });
}

void ElementIndex::Add(const Capsule& support)
{
  const bool isFirst = this->Supports.empty();
  for (int axis = 0; axis < 3; ++axis)
  {
    const double low =
      std::min(support.Start[axis] - support.StartRadius, support.End[axis] - support.EndRadius);
    const double high =
      std::max(support.Start[axis] + support.StartRadius, support.End[axis] + support.EndRadius);
    double* bounds = this->Bounds + 2 * axis;
    bounds[0] = isFirst ? low : std::min(bounds[0], low);
    bounds[1] = isFirst ? high : std::max(bounds[1], high);
  }
  this->Supports.push_back(support);
}

// Returns true if each element lies within the support that the cells list.
bool ElementIndex::AreListed() const
{
  constexpr double largest = 1.0 + 2.0 * MarginOfMoving; // larger supports give too many candidates
  const auto isWithin = [](const double at[3], double radius, const double centre[3], double reach)
  {
    const double x = at[0] - centre[0], y = at[1] - centre[1], z = at[2] - centre[2];
    const double room = reach - radius;
    return room >= 0.0 && reach <= largest * radius && x * x + y * y + z * z <= room * room;
  };
  // A condition at both ends of a segment also holds between them, because all quantities are
  // linear.
  return this->Listed.size() == this->Supports.size() &&
    std::equal(this->Supports.begin(), this->Supports.end(), this->Listed.begin(),
      [&](const Capsule& now, const Capsule& then)
      {
        return isWithin(now.Start, now.StartRadius, then.Start, then.StartRadius) &&
          isWithin(now.End, now.EndRadius, then.End, then.EndRadius);
      });
}

void ElementIndex::Build()
{
  if (this->AreListed())
  {
    return;
  }
  const bool moves = this->Listed.size() == this->Supports.size();
  const double factor = moves ? 1.0 + MarginOfMoving : 1.0;
  double largest = 0.0;
  this->Listed = this->Supports;
  for (Capsule& capsule : this->Listed)
  {
    largest = std::max({ largest, capsule.StartRadius, capsule.EndRadius });
    capsule.StartRadius *= factor;
    capsule.EndRadius *= factor;
  }
  double wide[6];
  for (int side = 0; side < 6; ++side)
  {
    wide[side] = this->Bounds[side] + (side % 2 ? 1.0 : -1.0) * (factor - 1.0) * largest;
  }
  try
  {
    this->Cells.Build(this->Listed, wide);
  }
  catch (...)
  {
    this->Listed.clear();
    this->Cells = SkeletonCells(); // a partial build would list missing elements
    throw;
  }
}

}
