/**
 * Consecutive numbers of lattice blocks, found by the blocks' indices.
 */
#ifndef IndexMap_h
#define IndexMap_h

#include "Base/NodeTarget.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace activesurface
{

/** Hash table with open addressing. Clear keeps the memory. */
class IndexMap
{
public:
  static constexpr std::int32_t None = -1;

  /** Removes all entries and reserves slots for `expected` entries. */
  void Clear(std::size_t expected)
  {
    this->Count = 0;
    std::size_t size = 64;
    while (size < 2 * expected)
    {
      size *= 2;
    }
    this->Slots.assign(size, Slot());
  }

  /** Returns the number of an index, or None. */
  std::int32_t Find(const NodeIndex& index) const
  {
    const Slot& slot = this->Slots[this->FindSlot(index)];
    return slot.Number;
  }

  /** Returns the number of an index. A new index gets the next number, beginning with 0. */
  std::int32_t Add(const NodeIndex& index)
  {
    if (2 * (this->Count + 1) > this->Slots.size())
    {
      this->Grow();
    }
    Slot& slot = this->Slots[this->FindSlot(index)];
    if (slot.Number == None)
    {
      slot = { index, static_cast<std::int32_t>(this->Count++) };
    }
    return slot.Number;
  }

  std::size_t Size() const { return this->Count; }

private:
  struct Slot
  {
    NodeIndex Index{};
    std::int32_t Number = None;
  };

  std::size_t FindSlot(const NodeIndex& index) const
  {
    std::uint64_t key = static_cast<std::uint32_t>(index[0]) * 0x9e3779b97f4a7c15ull;
    key = (key ^ (key >> 29)) + static_cast<std::uint32_t>(index[1]) * 0xbf58476d1ce4e5b9ull;
    key = (key ^ (key >> 31)) + static_cast<std::uint32_t>(index[2]) * 0x94d049bb133111ebull;
    const std::size_t last = this->Slots.size() - 1;
    std::size_t i = static_cast<std::size_t>(key ^ (key >> 32)) & last;
    while (this->Slots[i].Number != None && !AreSame(this->Slots[i].Index, index))
    {
      i = (i + 1) & last;
    }
    return i;
  }

  void Grow()
  {
    std::vector<Slot> old(2 * this->Slots.size());
    old.swap(this->Slots);
    for (const Slot& slot : old)
    {
      if (slot.Number != None)
      {
        this->Slots[this->FindSlot(slot.Index)] = slot;
      }
    }
  }

  std::vector<Slot> Slots = std::vector<Slot>(64);
  std::size_t Count = 0;
};

}

#endif
