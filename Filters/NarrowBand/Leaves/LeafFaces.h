/**
 * The faces of a leaf.
 */
#ifndef LeafFaces_h
#define LeafFaces_h

#include "Leaves/LeafMask.h"

namespace activesurface
{

/** Bits on the face of a mask that looks in the direction of an axis and a sign. */
inline bool TouchesFace(const LeafMask& mask, int axis, int sign)
{
  if (axis == 0)
  {
    return mask.Word[sign < 0 ? 0 : 7] != 0;
  }
  const std::uint64_t face = axis == 1 ? (sign < 0 ? 0xffull : 0xffull << 56)
                                       : (sign < 0 ? 1ull : 0x80ull) * 0x0101010101010101ull;
  std::uint64_t any = 0;
  for (std::uint64_t word : mask.Word)
  {
    any |= word & face;
  }
  return any != 0;
}

}

#endif
