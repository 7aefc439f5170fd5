// Room for the nodes of some leaves: those that have been given a place have their own, and keep
// it.

#include "Leaves/NodeArrays.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <set>

using namespace activesurface;

namespace TestNodeArrays
{

namespace
{

constexpr std::size_t Count = 200; // several blocks

// Every third leaf from one on.
void GiveEveryThird(std::size_t first, LeafSlots& slots)
{
  for (std::size_t leaf = first; leaf < slots.GetSlots().size(); leaf += 3)
  {
    slots.Give(leaf);
  }
}

void Fill(const NodeArrays& arrays, std::size_t first, std::size_t end)
{
  for (std::size_t leaf = first; leaf < end; leaf += 3)
  {
    std::fill_n(arrays.Of(leaf), 512, static_cast<float>(leaf));
  }
}

// Of every third leaf.
void ExpectFilled(const NodeArrays& arrays, std::size_t first, std::size_t end)
{
  for (std::size_t leaf = first; leaf < end; leaf += 3)
  {
    const float* values = arrays.Of(leaf);
    EXPECT_TRUE(std::all_of(
      values, values + 512, [leaf](float value) { return value == static_cast<float>(leaf); }))
      << leaf;
  }
}

}

TEST(TestNodeArrays, EachLeafHasItsOwnRoom)
{
  NodeArrays arrays;
  arrays.MakeRoom(Count);
  for (std::size_t first = 0; first < 3; ++first)
  {
    Fill(arrays, first, Count);
  }
  for (std::size_t first = 0; first < 3; ++first)
  {
    ExpectFilled(arrays, first, Count);
  }
}

TEST(TestNodeArrays, LeavesWithoutAPlaceTakeNoMoreRoom)
{
  LeafSlots slots;
  slots.Resize(Count);
  GiveEveryThird(1, slots);
  EXPECT_EQ(slots.Count(), 1 + (Count + 1) / 3);
  std::set<std::size_t> own;
  for (std::size_t leaf = 1; leaf < Count; leaf += 3)
  {
    own.insert(slots.GetSlots()[leaf]);
  }
  EXPECT_EQ(own.size(), (Count + 1) / 3);
  EXPECT_EQ(own.count(slots.GetSlots()[0]), 0u);
  EXPECT_EQ(slots.GetSlots()[0], slots.GetSlots()[2]);
}

TEST(TestNodeArrays, WhatIsThereStaysWhereMoreLeavesGetAPlace)
{
  LeafSlots slots;
  slots.Resize(Count);
  GiveEveryThird(1, slots);
  NodeArrays arrays;
  arrays.MakeRoom(slots);
  Fill(arrays, 1, Count);
  slots.Resize(2 * Count);
  GiveEveryThird(1, slots);
  GiveEveryThird(2, slots);
  arrays.MakeRoom(slots);
  Fill(arrays, 2, 2 * Count);
  ExpectFilled(arrays, 1, Count);
  ExpectFilled(arrays, 2, 2 * Count);
}

}
