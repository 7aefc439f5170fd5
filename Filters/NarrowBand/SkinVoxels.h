/**
 * The voxels that the surface crosses, and where it crosses their edges.
 */
#ifndef SkinVoxels_h
#define SkinVoxels_h

#include "CubeTriangles.h"
#include "LeafTable.h"

namespace activesurface
{

/** Bit c set: corner c = 4 x + 2 y + z of the voxel with this lower corner is inside. */
inline unsigned InsideCorners(const LeafTable& table, std::int32_t leaf, int node)
{
  unsigned bits = 0;
  for (int corner = 0; corner < CornersOfVoxel; ++corner)
  {
    const LeafTable::Place place =
      table.Offset(leaf, node, corner >> 2, corner >> 1 & 1, corner & 1);
    const bool inside =
      place.Leaf >= 0 ? table[place.Leaf].Inside.Has(place.Node) : place.Leaf == NoLeafInside;
    bits |= unsigned(inside) << corner;
  }
  return bits;
}

/** Calls function(node, bits) for the crossed voxels whose lower corner is in the leaf. */
template <class Function>
void ForEachCrossedVoxel(const LeafTable& table, std::size_t i, Function&& function)
{
  const std::int32_t leaf = static_cast<std::int32_t>(i);
  table[i].Upto[0].ForEach(
    [&](int node)
    {
      const unsigned bits = InsideCorners(table, leaf, node);
      if (bits != 0 && bits != 0xffu)
      {
        function(node, bits);
      }
    });
}

}

#endif
