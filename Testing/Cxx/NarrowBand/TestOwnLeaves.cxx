// Which ranks have the leaves in a box: those of each of its leaves, and no others.

#include "Support/ThreadRanks.h"

#include "Leaves/RankedLeaves.h"
#include "MortonOrder.h"
#include "Parts/OwnLeaves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <vector>

using namespace activesurface;

namespace TestOwnLeaves
{

namespace
{

constexpr double VoxelSize = 0.5;

class Places
{
public:
  int At(int low, int high)
  {
    return std::uniform_int_distribution<int>(low, high)(this->Generator);
  }
  openvdb::Coord Leaf(int far)
  {
    return { 8 * this->At(-far, far), 8 * this->At(-far, far), 8 * this->At(-far, far) };
  }

private:
  std::mt19937 Generator{ 11 };
};

// Around 0, where the signs differ, and crowded on one side.
std::vector<openvdb::Coord> MakeOrigins()
{
  Places places;
  std::vector<openvdb::Coord> origins;
  for (int i = 0; i < 300; ++i)
  {
    origins.push_back(places.Leaf(9));
    origins.push_back(places.Leaf(2) + openvdb::Coord(48, 0, -24));
  }
  std::sort(origins.begin(), origins.end(), AreLeavesInOrder);
  origins.erase(std::unique(origins.begin(), origins.end()), origins.end());
  return origins;
}

int FloorToLeaf(double voxel)
{
  return 8 * static_cast<int>(std::floor(voxel / 8.0));
}

// A voxel around a box counts, as samples are on edges between leaves.
std::set<int> ListOwners(const RankedLeaves& owners, const double bounds[6])
{
  openvdb::Coord first, last;
  for (int axis = 0; axis < 3; ++axis)
  {
    first[axis] = FloorToLeaf(bounds[2 * axis] / VoxelSize - 1.0);
    last[axis] = FloorToLeaf(bounds[2 * axis + 1] / VoxelSize + 1.0);
  }
  std::set<int> ranks;
  for (int x = first[0]; x <= last[0]; x += 8)
  {
    for (int y = first[1]; y <= last[1]; y += 8)
    {
      for (int z = first[2]; z <= last[2]; z += 8)
      {
        ranks.insert(owners.FindOwner({ x, y, z }));
      }
    }
  }
  return ranks;
}

std::set<int> FindRanks(const OwnLeaves& places, const double bounds[6])
{
  std::vector<int> ranks;
  places.FindRanks(bounds, ranks);
  EXPECT_EQ(std::set<int>(ranks.begin(), ranks.end()).size(), ranks.size()) << "none comes twice";
  return { ranks.begin(), ranks.end() };
}

}

TEST(TestOwnLeaves, PlacesInABoxAreBetweenItsCornersInMortonOrder)
{
  Places places;
  for (int i = 0; i < 20000; ++i)
  {
    const int far = i % 2 ? 4 : 1 << 24;
    openvdb::Coord low = places.Leaf(far), high = places.Leaf(far), within;
    for (int axis = 0; axis < 3; ++axis)
    {
      if (low[axis] > high[axis])
      {
        std::swap(low[axis], high[axis]);
      }
      within[axis] = 8 * places.At(low[axis] / 8, high[axis] / 8);
    }
    ASSERT_FALSE(AreLeavesInOrder(within, low)) << low << " " << within;
    ASSERT_FALSE(AreLeavesInOrder(high, within)) << within << " " << high;
    ASSERT_NE(AreLeavesInOrder(low, high), low == high) << low << " " << high;
  }
}

TEST(TestOwnLeaves, BoxesHaveTheRanksOfTheirLeaves)
{
  const std::vector<openvdb::Coord> origins = MakeOrigins();
  RunOnRanks(5,
    [&](Agreement& ranks)
    {
      const RankedLeaves owners(ranks, origins);
      const OwnLeaves places(owners, VoxelSize);
      Places random;
      std::size_t several = 0;
      for (int i = 0; i < 2000; ++i)
      {
        double bounds[6];
        for (int axis = 0; axis < 3; ++axis)
        {
          bounds[2 * axis] = VoxelSize * random.At(-90, 90);
          bounds[2 * axis + 1] = bounds[2 * axis] + VoxelSize * random.At(0, 20);
        }
        const std::set<int> found = FindRanks(places, bounds);
        ASSERT_EQ(found, ListOwners(owners, bounds));
        several += found.size() > 1;
      }
      EXPECT_GT(several, 100u);
    });
}

// Of a box with too many leaves to look at each, and of all of space.
TEST(TestOwnLeaves, LargeBoxesMissNone)
{
  RunOnRanks(5,
    [&](Agreement& ranks)
    {
      const RankedLeaves owners(ranks, MakeOrigins());
      const OwnLeaves places(owners, VoxelSize);
      const double large[6] = { -40.0, 40.0, -40.0, 40.0, -40.0, 40.0 };
      EXPECT_EQ(FindRanks(places, large).size(), 5u);
      const double all[6] = { -HUGE_VAL, HUGE_VAL, -HUGE_VAL, HUGE_VAL, -HUGE_VAL, HUGE_VAL };
      EXPECT_EQ(FindRanks(places, all).size(), 5u);
    });
}

}
