// Partition of space among ranks: each leaf has one owner, costs are balanced, and the owners of
// all nodes in a box are found.

#include "Base/FixedSum.h"
#include "Ranks/Domain.h"
#include "Ranks/RankBytes.h"
#include "Support/ThreadRanks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <set>
#include <vector>

using namespace activesurface;

namespace TestDomain
{

namespace
{

// Leaves of a slab, each on one of the ranks.
std::vector<LeafCost> MakeLeaves(int rank, int ranks)
{
  std::mt19937 random(7);
  std::vector<LeafCost> own;
  for (int i = 0; i < 4000; ++i)
  {
    const NodeIndex leaf = { 8 * (i % 40) - 160, 8 * (i / 40 % 25) - 64, 8 * (i / 1000) };
    const double cost = 1.0 + random() % 100;
    if (i % ranks == rank)
    {
      own.push_back({ leaf, cost });
    }
  }
  return own;
}

}

TEST(TestDomain, CostsAreBalancedAndTheSameOnAllRanks)
{
  constexpr int size = 5;
  std::vector<std::vector<int>> owners(size);
  RunOnRanks(size,
    [&](Agreement& ranks)
    {
      const auto domain = Domain::Share(ranks, MakeLeaves(ranks.GetRank(), size));
      for (const LeafCost& leaf : MakeLeaves(0, 1))
      {
        owners[static_cast<std::size_t>(ranks.GetRank())].push_back(domain->OwnerOf(leaf.Origin));
      }
    });
  std::vector<double> costs(size, 0.0);
  const std::vector<LeafCost> leaves = MakeLeaves(0, 1);
  for (std::size_t i = 0; i < leaves.size(); ++i)
  {
    costs[static_cast<std::size_t>(owners[0][i])] += leaves[i].Cost;
  }
  for (int rank = 1; rank < size; ++rank)
  {
    EXPECT_EQ(owners[static_cast<std::size_t>(rank)], owners[0]);
  }
  const double mean = std::accumulate(costs.begin(), costs.end(), 0.0) / size;
  // Each plane between parts is off by up to half a layer of leaves.
  EXPECT_LT(*std::max_element(costs.begin(), costs.end()), 1.15 * mean);
  EXPECT_GT(*std::min_element(costs.begin(), costs.end()), 0.85 * mean);
}

TEST(TestDomain, AllNodesOfALeafHaveItsOwner)
{
  RunOnRanks(3,
    [&](Agreement& ranks)
    {
      const auto domain = Domain::Share(ranks, MakeLeaves(ranks.GetRank(), 3));
      for (const LeafCost& leaf : MakeLeaves(0, 1))
      {
        const NodeIndex last = { leaf.Origin[0] + 7, leaf.Origin[1] + 7, leaf.Origin[2] + 7 };
        EXPECT_EQ(domain->OwnerOf(last), domain->OwnerOf(leaf.Origin));
      }
    });
}

TEST(TestDomain, NothingToShareIsOneRanks)
{
  RunOnRanks(3,
    [&](Agreement& ranks)
    {
      const auto domain = Domain::Share(ranks, {});
      EXPECT_EQ(domain->OwnerOf({ -1000, 5, 1000 }), 0);
      EXPECT_EQ(domain->IsOwn({ 0, 0, 0 }), ranks.GetRank() == 0);
    });
}

TEST(TestDomain, OwnersInABoxAreThoseOfItsNodes)
{
  RunOnRanks(7,
    [&](Agreement& ranks)
    {
      const auto domain = Domain::Share(ranks, MakeLeaves(ranks.GetRank(), 7));
      std::mt19937 random(11);
      const auto draw = [&](int side) { return static_cast<int>(random() % side) - side / 2; };
      for (int i = 0; i < 500; ++i)
      {
        const NodeIndex low = { draw(400), draw(300), draw(100) };
        const NodeIndex high = { low[0] + 40 + draw(80), low[1] + 30 + draw(60),
          low[2] + 20 + draw(40) };
        std::set<int> expected;
        NodeIndex node;
        for (node[0] = low[0]; node[0] <= high[0]; ++node[0])
        {
          for (node[1] = low[1]; node[1] <= high[1]; ++node[1])
          {
            for (node[2] = low[2]; node[2] <= high[2]; ++node[2])
            {
              expected.insert(domain->OwnerOf(node));
            }
          }
        }
        std::vector<int> found;
        domain->ListOwners(low, high, found);
        EXPECT_EQ(found, std::vector<int>(expected.begin(), expected.end()));
      }
    });
}

TEST(TestDomain, BytesComeFromThoseWhoSentThem)
{
  constexpr int size = 4;
  RunOnRanks(size,
    [&](Agreement& ranks)
    {
      std::vector<Bytes> toEach;
      for (int to = 0; to < size; ++to)
      {
        toEach.push_back(ToBytes(std::vector<int>(static_cast<std::size_t>(to), ranks.GetRank())));
      }
      const std::vector<Bytes> fromEach = ranks.Distribute(toEach);
      for (int from = 0; from < size; ++from)
      {
        EXPECT_EQ(FromBytes<int>(fromEach[static_cast<std::size_t>(from)]),
          std::vector<int>(static_cast<std::size_t>(ranks.GetRank()), from));
      }
    });
}

TEST(TestDomain, SumsDoNotDependOnTheOrder)
{
  std::mt19937 random(3);
  std::vector<double> values;
  for (int i = 0; i < 10000; ++i)
  {
    const double sign = i % 2 == 0 ? 1.0 : -1.0;
    values.push_back(sign * std::ldexp(double(random()), int(random() % 40) - 40));
  }
  FixedSum forward, backward, parts[3], together;
  long double exact = 0.0L;
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    forward.Add(values[i]);
    backward.Add(values[values.size() - 1 - i]);
    parts[i % 3].Add(values[i]);
    exact += values[i];
  }
  for (const FixedSum& part : parts)
  {
    together.Add(part);
  }
  EXPECT_EQ(forward.Get(), backward.Get());
  EXPECT_EQ(forward.Get(), together.Get());
  // Each term is rounded by at most half of 2^-32.
  EXPECT_NEAR(forward.Get(), static_cast<double>(exact), 10000 * std::ldexp(0.5, -32));
}

}
