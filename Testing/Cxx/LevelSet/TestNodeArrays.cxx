// Arrays of numbers at the nodes of leaves: each leaf has its own array, which keeps its values
// when more leaves are added.

#include "Leaves/NodeArrays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>

using namespace activesurface;

namespace TestNodeArrays
{

namespace
{

constexpr std::size_t Count = 200; // several blocks

void Fill(const NodeArrays& arrays, std::size_t first, std::size_t end)
{
  for (std::size_t leaf = first; leaf < end; ++leaf)
  {
    std::fill_n(arrays.Of(leaf), 512, static_cast<float>(leaf));
  }
}

void ExpectFilled(const NodeArrays& arrays, std::size_t end)
{
  for (std::size_t leaf = 0; leaf < end; ++leaf)
  {
    const float* values = arrays.Of(leaf);
    EXPECT_TRUE(std::all_of(
      values, values + 512, [leaf](float value) { return value == static_cast<float>(leaf); }))
      << leaf;
  }
}

}

TEST(TestNodeArrays, EachLeafHasItsOwnRoomAndKeepsIt)
{
  NodeArrays arrays;
  arrays.MakeRoom(Count);
  Fill(arrays, 0, Count);
  arrays.MakeRoom(2 * Count);
  Fill(arrays, Count, 2 * Count);
  ExpectFilled(arrays, 2 * Count);
}

}
