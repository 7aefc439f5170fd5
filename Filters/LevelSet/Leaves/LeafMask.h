/**
 * Masks with one bit per node of a leaf, and shifts to neighbour nodes.
 *
 * A leaf has 8 x 8 x 8 nodes; node (x,y,z) is bit 8 y + z of word x, as in OpenVDB. A mask is
 * shifted by some nodes together with the mask of the neighbour leaf, which supplies the missing
 * planes. Each operation on a word treats 64 nodes at once.
 */
#ifndef LeafMask_h
#define LeafMask_h

#include "Base/InstructionSets.h"

#include <array>
#include <cstdint>

namespace activesurface
{

struct LeafMask
{
  std::array<std::uint64_t, 8> Word{};

  static constexpr LeafMask All()
  {
    return { { ~0ull, ~0ull, ~0ull, ~0ull, ~0ull, ~0ull, ~0ull, ~0ull } };
  }

  bool Has(int node) const { return (this->Word[node >> 6] >> (node & 63)) & 1u; }
  void Add(int node) { this->Word[node >> 6] |= std::uint64_t(1) << (node & 63); }
  void Remove(int node) { this->Word[node >> 6] &= ~(std::uint64_t(1) << (node & 63)); }

  /** The eight bits of the row (x, y). */
  unsigned Row(int x, int y) const { return (this->Word[x] >> (8 * y)) & 0xffu; }

  ACTIVE_ALWAYS_INLINE bool Any() const
  {
    std::uint64_t any = 0;
    for (std::uint64_t word : this->Word)
    {
      any |= word;
    }
    return any != 0;
  }

  int Count() const
  {
    int count = 0;
    for (std::uint64_t word : this->Word)
    {
      count += CountBits(word);
    }
    return count;
  }

  ACTIVE_ALWAYS_INLINE LeafMask operator|(const LeafMask& other) const
  {
    return this->Combine(other, [](std::uint64_t a, std::uint64_t b) { return a | b; });
  }
  ACTIVE_ALWAYS_INLINE LeafMask operator&(const LeafMask& other) const
  {
    return this->Combine(other, [](std::uint64_t a, std::uint64_t b) { return a & b; });
  }
  ACTIVE_ALWAYS_INLINE LeafMask operator^(const LeafMask& other) const
  {
    return this->Combine(other, [](std::uint64_t a, std::uint64_t b) { return a ^ b; });
  }
  ACTIVE_ALWAYS_INLINE LeafMask Without(const LeafMask& other) const
  {
    return this->Combine(other, [](std::uint64_t a, std::uint64_t b) { return a & ~b; });
  }
  bool operator==(const LeafMask& other) const { return this->Word == other.Word; }

  template <class Function>
  ACTIVE_ALWAYS_INLINE LeafMask Combine(const LeafMask& other, Function&& function) const
  {
    LeafMask result;
    for (int x = 0; x < 8; ++x)
    {
      result.Word[x] = function(this->Word[x], other.Word[x]);
    }
    return result;
  }

  /** Calls function(node) for each bit in ascending order. */
  template <class Function>
  ACTIVE_ALWAYS_INLINE void ForEach(Function&& function) const
  {
    for (int x = 0; x < 8; ++x)
    {
      for (std::uint64_t word = this->Word[x]; word != 0; word &= word - 1)
      {
        function(64 * x + LowestBit(word));
      }
    }
  }
};

/** Returns the mask whose node n is set if `mask` has n + steps along x, y or z (axis 0, 1, 2).
 * next: the mask of the neighbour leaf in that direction. steps: 1 to 7. */
ACTIVE_ALWAYS_INLINE LeafMask SeenAhead(
  const LeafMask& mask, const LeafMask& next, int axis, int steps)
{
  LeafMask seen;
  const std::uint64_t low = ((1u << steps) - 1u) * 0x0101010101010101ull;
  for (int x = 0; x < 8; ++x)
  {
    const int ahead = x + steps;
    seen.Word[x] = axis == 0 ? (ahead < 8 ? mask.Word[ahead] : next.Word[ahead - 8])
      : axis == 1            ? (mask.Word[x] >> (8 * steps)) | (next.Word[x] << (64 - 8 * steps))
                  : ((mask.Word[x] & ~low) >> steps) | ((next.Word[x] & low) << (8 - steps));
  }
  return seen;
}

/** Returns the mask whose node n is set if `mask` has n - steps. previous: the mask of the
 * neighbour leaf in that direction. steps: 1 to 7. */
ACTIVE_ALWAYS_INLINE LeafMask SeenBehind(
  const LeafMask& mask, const LeafMask& previous, int axis, int steps)
{
  LeafMask seen;
  const std::uint64_t low = (0xffu >> steps) * 0x0101010101010101ull;
  for (int x = 0; x < 8; ++x)
  {
    const int behind = x - steps;
    seen.Word[x] = axis == 0 ? (behind >= 0 ? mask.Word[behind] : previous.Word[behind + 8])
      : axis == 1 ? (mask.Word[x] << (8 * steps)) | (previous.Word[x] >> (64 - 8 * steps))
                  : ((mask.Word[x] & low) << steps) | ((previous.Word[x] & ~low) >> (8 - steps));
  }
  return seen;
}

}

#endif
