// Results that ranks make together: each has all of them in the end, and of no size too.

#include "SharedResults.h"
#include "Support/ThreadRanks.h"

#include <gtest/gtest.h>

#include <numeric>

using namespace activesurface;

namespace TestSharedResults
{

// An empty vector has no address, and may not be copied from or to by what wants one.
TEST(TestSharedResults, SomeRanksHaveNothing)
{
  RunOnRanks(3,
    [](Agreement& ranks)
    {
      const std::vector<double> own(ranks.GetRank() == 1 ? 2 : 0, 0.5);
      const auto all = GatherResults(
        ranks, own, [](std::vector<double>& values, auto& pass) { PassVector(values, pass); });
      const std::vector<std::vector<double>> expected = { {}, { 0.5, 0.5 }, {} };
      EXPECT_EQ(all, expected);
    });
}

namespace
{

// Each rank makes a third of them, and is told the others.
void ShareNumbers(std::size_t count)
{
  RunOnRanks(3,
    [count](Agreement& ranks)
    {
      std::vector<int> results(count, -1), expected(count);
      std::size_t made = 0;
      ShareResults(
        &ranks, count,
        [&](std::size_t first, std::size_t end)
        {
          made = end - first;
          std::iota(results.data() + first, results.data() + end, static_cast<int>(first));
        },
        [&](std::size_t n, auto& pass) { pass(&results[n], 1); });
      std::iota(expected.begin(), expected.end(), 0);
      EXPECT_EQ(results, expected);
      EXPECT_EQ(made, (count + 2 - static_cast<std::size_t>(ranks.GetRank())) / 3);
    });
}

}

TEST(TestSharedResults, EachMakesItsRange)
{
  for (const std::size_t count : { 0, 2, 7 })
  {
    ShareNumbers(count);
  }
}

// So many that they are told in several rounds, the last of which is one for the first rank alone.
TEST(TestSharedResults, ManyAreToldInRounds)
{
  ShareNumbers(3 * 16384);
  ShareNumbers(3 * 2 * 16384 + 1);
}

TEST(TestSharedResults, LessThanWasToldIsAnError)
{
  const Bytes bytes(7);
  double value = 0.0;
  EXPECT_THROW(ByteReader{ bytes }(&value, 1), std::runtime_error);
}

}
