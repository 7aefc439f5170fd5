// Partition of leaves over ranks: each leaf has one owner, and costs are balanced.

#include "Ranks/Domain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <random>

using namespace activesurface;

namespace TestLeafRanges
{

namespace
{

std::vector<std::size_t> MakeCosts(std::size_t leaves, unsigned seed)
{
  std::mt19937 random(seed);
  std::vector<std::size_t> before(1, 0);
  for (std::size_t i = 0; i < leaves; ++i)
  {
    before.push_back(before.back() + random() % 4 * (random() % 100));
  }
  return before;
}

}

TEST(TestLeafRanges, EachLeafIsOfOneRank)
{
  for (const int ranks : { 1, 2, 3, 7, 64 })
  {
    const std::vector<std::size_t> first = ShareLeaves(MakeCosts(1000, 1), ranks);
    ASSERT_EQ(first.size(), static_cast<std::size_t>(ranks) + 1);
    EXPECT_EQ(first.front(), 0u);
    EXPECT_EQ(first.back(), 1000u);
    EXPECT_TRUE(std::is_sorted(first.begin(), first.end())) << ranks << " ranks";
  }
}

TEST(TestLeafRanges, SharesAreEvenButForALeaf)
{
  const std::vector<std::size_t> before = MakeCosts(5000, 2);
  std::size_t largest = 0;
  for (std::size_t i = 1; i < before.size(); ++i)
  {
    largest = std::max(largest, before[i] - before[i - 1]);
  }
  constexpr int ranks = 16;
  const std::vector<std::size_t> first = ShareLeaves(before, ranks);
  for (std::size_t rank = 0; rank < ranks; ++rank)
  {
    const auto costs = static_cast<std::int64_t>(before[first[rank + 1]] - before[first[rank]]);
    const auto even = static_cast<std::int64_t>(before.back() / ranks);
    EXPECT_LE(std::abs(costs - even), static_cast<std::int64_t>(largest) + 1) << "of rank " << rank;
  }
}

TEST(TestLeafRanges, ThereMayBeMoreRanksThanLeaves)
{
  EXPECT_EQ(ShareLeaves({ 0 }, 3), (std::vector<std::size_t>{ 0, 0, 0, 0 })) << "no leaf";
  const std::vector<std::size_t> first = ShareLeaves({ 0, 5 }, 3);
  EXPECT_EQ(first.back(), 1u);
  EXPECT_TRUE(std::is_sorted(first.begin(), first.end()));
}

TEST(TestLeafRanges, CostsMayBeHuge)
{
  constexpr std::size_t huge = std::size_t(1) << 62;
  EXPECT_EQ(ShareLeaves({ 0, huge / 2, huge }, 2), (std::vector<std::size_t>{ 0, 1, 2 }));
}

}
