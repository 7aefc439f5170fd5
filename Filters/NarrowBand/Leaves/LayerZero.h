/**
 * Layer 0: the corners of the voxels that the surface crosses.
 */
#ifndef LayerZero_h
#define LayerZero_h

#include "Leaves/LeafTable.h"

namespace activesurface
{

/** Bits of the voxels that the surface crosses, from the signs of four rows of corners, which lie
 * side by side along x and y; a voxel's corners are at its own bit and the next. */
ACTIVE_ALWAYS_INLINE unsigned CrossedInRow(unsigned a, unsigned b, unsigned c, unsigned d)
{
  const unsigned any = a | b | c | d, all = a & b & c & d;
  return (any | any >> 1) & ~(all & all >> 1);
}

/** Upto[0] of these leaves from the signs, and in Wanted the missing neighbours that have a corner.
 */
void FindLayerZero(LeafTable& table, const LeafList& leaves);

}

#endif
