// Bits of the 8^3 cells of a block: cell (x, y, z) is bit 8 y + z of word x.

#ifndef CellMask_h
#define CellMask_h

#include <array>
#include <cstdint>

namespace activesurface
{

struct CellMask
{
  std::array<std::uint64_t, 8> Word{};

  static CellMask All()
  {
    CellMask all;
    all.Word.fill(~std::uint64_t(0));
    return all;
  }

  static constexpr int Bit(int y, int z) { return 8 * y + z; }
  bool Has(int x, int y, int z) const { return ((this->Word[x] >> Bit(y, z)) & 1) != 0; }
  void Add(int x, int y, int z) { this->Word[x] |= std::uint64_t(1) << Bit(y, z); }
  // The eight cells along z.
  unsigned Row(int x, int y) const { return (this->Word[x] >> (8 * y)) & 0xffu; }

  bool Any() const
  {
    std::uint64_t any = 0;
    for (const std::uint64_t word : this->Word)
    {
      any |= word;
    }
    return any != 0;
  }

  // The cells whose neighbour before or after them on an axis, or which themselves, are in the
  // mask. before, after: the masks of the blocks there.
  CellMask Widen(const CellMask& before, const CellMask& after, int axis) const
  {
    CellMask wide;
    for (int x = 0; x < 8; ++x)
    {
      const std::uint64_t own = this->Word[x], low = before.Word[x], high = after.Word[x];
      if (axis == 0)
      {
        wide.Word[x] = own | (x > 0 ? this->Word[x - 1] : before.Word[7]) |
          (x < 7 ? this->Word[x + 1] : after.Word[0]);
      }
      else if (axis == 1)
      {
        wide.Word[x] = own | own << 8 | low >> 56 | own >> 8 | high << 56;
      }
      else
      {
        constexpr std::uint64_t first = 0x0101010101010101ull, last = first << 7;
        wide.Word[x] =
          own | (own << 1 & ~first) | (low >> 7 & first) | (own >> 1 & ~last) | (high << 7 & last);
      }
    }
    return wide;
  }
};

}

#endif
