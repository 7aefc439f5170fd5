// Groups of nearby points: each point is in one group, and no group is too wide.

#include "PlaceGroups.h"

#include "Support/SkeletonShapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <vector>

using namespace activesurface;

namespace TestPlaceGroups
{

TEST(TestPlaceGroups, EachPlaceIsInOneSmallGroup)
{
  constexpr double size = 1.2, nan = std::numeric_limits<double>::quiet_NaN();
  constexpr int most = 8;
  Random random(10);
  std::vector<double> places;
  for (std::size_t i = 0; i < PlaceGroups::Capacity; ++i)
  {
    const Point p = random.In(-1.0, 1.0);
    const double far = i % 16 == 0 ? 1e300 : 1.0;
    places.insert(places.end(), { far * p[0], p[1], i % 32 == 1 ? nan : p[2] });
  }
  const PlaceGroups groups(PlaceGroups::Capacity, places.data(), size);
  std::multiset<std::size_t> seen;
  int largest = 0;
  groups.ForEachGroup(most,
    [&](const std::size_t* members, int count)
    {
      largest = std::max(largest, count);
      for (int k = 0; k < count; ++k)
      {
        seen.insert(members[k]);
        for (int axis = 0; axis < 3; ++axis)
        {
          const double way = places[3 * members[k] + axis] - places[3 * members[0] + axis];
          EXPECT_LE(std::fabs(way), size);
        }
      }
    });
  EXPECT_EQ(largest, most);
  EXPECT_EQ(seen.count(1), 0u) << "not finite";
  groups.GetFinite().ForEachOther([&](std::size_t i) { seen.insert(i); });
  for (std::size_t i = 0; i < PlaceGroups::Capacity; ++i)
  {
    EXPECT_EQ(seen.count(i), 1u);
  }
}

}
