/**
 * Layer 0: the corners of the voxels that the surface crosses.
 */
#ifndef LayerZero_h
#define LayerZero_h

#include "Leaves/LeafTable.h"

namespace activesurface
{

/** Returns the crossed voxels of a row, one bit each, from the sign bits of the four rows of
 * corners around the row. In each of the four rows, the corners of a voxel are the voxel's own bit
 * and the next bit. */
ACTIVE_ALWAYS_INLINE unsigned CrossedInRow(unsigned a, unsigned b, unsigned c, unsigned d)
{
  const unsigned any = a | b | c | d, all = a & b & c & d;
  return (any | any >> 1) & ~(all & all >> 1);
}

/** Finds UpToLayer[0] of these leaves from the signs. Sets MissingNeighbours to those neighbours
 * that have no leaf but contain a node of layer 0. */
void FindLayerZero(LeafTable& table, const LeafList& leaves);

}

#endif
