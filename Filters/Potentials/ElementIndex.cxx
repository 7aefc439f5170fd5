#include "ElementIndex.h"

#include <algorithm>

namespace activesurface
{
namespace
{
// Of the radius: more means more that is looked at in vain, less means more builds.
constexpr double MarginOfMoving = 0.1;
}

// Whether each element lies within what the cells list for it.
bool ElementIndex::Includes(const std::vector<Capsule>& capsules) const
{
  constexpr double largest = 1.0 + 2.0 * MarginOfMoving; // then cells list too much
  const auto isWithin = [](const double at[3], double radius, const double centre[3], double reach)
  {
    const double x = at[0] - centre[0], y = at[1] - centre[1], z = at[2] - centre[2];
    const double room = reach - radius;
    return room >= 0.0 && reach <= largest * radius && x * x + y * y + z * z <= room * room;
  };
  // What holds at both ends of a segment holds between them: all runs linearly.
  return this->Listed.size() == capsules.size() &&
    std::equal(capsules.begin(), capsules.end(), this->Listed.begin(),
      [&](const Capsule& now, const Capsule& then)
      {
        return isWithin(now.Start, now.StartRadius, then.Start, then.StartRadius) &&
          isWithin(now.End, now.EndRadius, then.End, then.EndRadius);
      });
}

void ElementIndex::Build(const std::vector<Capsule>& capsules, const double bounds[6])
{
  if (this->Includes(capsules))
  {
    return;
  }
  const bool moves = this->Listed.size() == capsules.size();
  const double factor = moves ? 1.0 + MarginOfMoving : 1.0;
  double largest = 0.0;
  this->Listed = capsules;
  for (Capsule& capsule : this->Listed)
  {
    largest = std::max({ largest, capsule.StartRadius, capsule.EndRadius });
    capsule.StartRadius *= factor;
    capsule.EndRadius *= factor;
  }
  double wide[6];
  for (int side = 0; side < 6; ++side)
  {
    wide[side] = bounds[side] + (side % 2 ? 1.0 : -1.0) * (factor - 1.0) * largest;
  }
  try
  {
    this->Cells.Build(this->Listed, wide);
  }
  catch (...)
  {
    this->Listed.clear();
    this->Cells = SkeletonCells(); // what is half built lists elements that are not there
    throw;
  }
}

}
