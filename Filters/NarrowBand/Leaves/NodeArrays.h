/**
 * Numbers for the nodes of leaves.
 */
#ifndef NodeArrays_h
#define NodeArrays_h

#include "Leaves/LeafTable.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace activesurface
{

/** 512 numbers per leaf, in blocks that are small enough for free memory of the heap. */
class NodeArrays
{
public:
  /** Of ranks, each has room for its own leaves and those beside them. What is there stays, as long
   * as the leaves have their numbers. */
  void MakeRoom(const LeafTable& table)
  {
    if (const LeafOwners* ranks = table.GetRanks())
    {
      this->MakeRoom(ranks->GetSlots());
    }
    else
    {
      this->MakeRoom(table.Size());
    }
  }

  void MakeRoom(std::size_t leaves)
  {
    this->Slots.clear();
    this->MakeBlocks(leaves);
  }

  void MakeRoom(const LeafSlots& slots)
  {
    this->Slots = slots.GetSlots();
    this->MakeBlocks(slots.Count());
  }

  float* Of(std::size_t leaf) const
  {
    const std::size_t slot = this->Slots.empty() ? leaf : this->Slots[leaf];
    return this->Blocks[slot / LeavesAtOnce].get() + 512 * (slot % LeavesAtOnce);
  }

private:
  void MakeBlocks(std::size_t leaves)
  {
    while (LeavesAtOnce * this->Blocks.size() < leaves)
    {
      this->Blocks.emplace_back(new float[512 * LeavesAtOnce]);
    }
  }

  static constexpr std::size_t LeavesAtOnce = 32;
  std::vector<std::unique_ptr<float[]>> Blocks;
  std::vector<std::uint32_t> Slots; //< of the leaves; none: each has its own number
};

}

#endif
