/**
 * Faces of a leaf, and connections within a leaf and across its faces.
 */
#ifndef LeafFaces_h
#define LeafFaces_h

#include "Leaves/LeafMask.h"

namespace activesurface
{

/** Returns true if the mask has nodes on the face in the direction of an axis and a sign. */
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

/** Returns the nodes of the next leaf, in the direction of an axis and a sign, that are neighbours
 * of the nodes in `mask`. */
inline LeafMask SeenAcross(const LeafMask& mask, int axis, int sign)
{
  return sign > 0 ? SeenBehind(LeafMask(), mask, axis, 1) : SeenAhead(LeafMask(), mask, axis, 1);
}

/** Returns `from` and all nodes of the leaf that edges within `nodes` connect with `from`. */
inline LeafMask GrowInLeaf(const LeafMask& from, const LeafMask& nodes)
{
  const LeafMask nothing;
  LeafMask grown = from, before;
  do
  {
    before = grown;
    for (int axis = 0; axis < 3; ++axis)
    {
      const LeafMask next =
        SeenAhead(grown, nothing, axis, 1) | SeenBehind(grown, nothing, axis, 1);
      grown = grown | (next & nodes);
    }
  } while (!(grown == before));
  return grown;
}

}

#endif
