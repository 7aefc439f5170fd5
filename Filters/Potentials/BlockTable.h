// Hash table of blocks of cells by their coordinates. Blocks are numbered in the order of
// insertion.

#ifndef BlockTable_h
#define BlockTable_h

#include "CompilerBuiltins.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace activesurface
{

class BlockTable
{
public:
  using Index = std::uint32_t;
  using Coordinate = std::int64_t;

  static constexpr Index None = 0xffffffff;

  struct Block
  {
    Coordinate At[3];
    int Level; // lattice of the block

    bool operator==(const Block& other) const
    {
      return this->At[0] == other.At[0] && this->At[1] == other.At[1] &&
        this->At[2] == other.At[2] && this->Level == other.Level;
    }
  };

  // Keeps allocated memory.
  void Clear()
  {
    this->Blocks.clear();
    this->Table.assign(LeastTable, None);
  }

  std::size_t Size() const { return this->Blocks.size(); }
  const Block& operator[](std::size_t i) const { return this->Blocks[i]; }

  // Returns the index of a block, or None.
  ACTIVE_ALWAYS_INLINE Index Find(const Block& block) const
  {
    return this->Table.empty() ? None : this->Table[this->FindPlace(block)];
  }

  // Returns the index of a block; inserts the block if it is missing.
  Index Add(const Block& block)
  {
    Index& number = this->Table[this->FindPlace(block)];
    if (number != None)
    {
      return number;
    }
    const auto added = static_cast<Index>(this->Blocks.size());
    number = added;
    this->Blocks.push_back(block);
    if (2 * this->Blocks.size() > this->Table.size())
    {
      this->Grow();
    }
    return added;
  }

private:
  static constexpr std::size_t LeastTable = 64; // a power of two

  ACTIVE_ALWAYS_INLINE static std::size_t GetHash(const Block& block)
  {
    const std::uint64_t sum = static_cast<std::uint64_t>(block.At[0]) * 0x9e3779b97f4a7c15u +
      static_cast<std::uint64_t>(block.At[1]) * 0xc2b2ae3d27d4eb4fu +
      static_cast<std::uint64_t>(block.At[2]) * 0x165667b19e3779f9u +
      static_cast<std::uint64_t>(block.Level) * 0x27d4eb2f165667c5u;
    return static_cast<std::size_t>(sum ^ sum >> 32);
  }

  // Returns the position of a block, or the position for its insertion.
  ACTIVE_ALWAYS_INLINE std::size_t FindPlace(const Block& block) const
  {
    const std::size_t last = this->Table.size() - 1;
    std::size_t place = GetHash(block) & last;
    while (this->Table[place] != None && !(this->Blocks[this->Table[place]] == block))
    {
      place = (place + 1) & last;
    }
    return place;
  }

  void Grow()
  {
    this->Table.assign(2 * this->Table.size(), None);
    for (std::size_t i = 0; i < this->Blocks.size(); ++i)
    {
      this->Table[this->FindPlace(this->Blocks[i])] = static_cast<Index>(i);
    }
  }

  std::vector<Block> Blocks;
  std::vector<Index> Table; // indices, or None; at least half of the entries are None
};

}

#endif
