/**
 * Partition of a band among ranks. Each rank has its own leaves and a halo. The halo consists of
 * the other ranks' leaves next to the box of space that the rank owns (Domain).
 */
#ifndef BandPart_h
#define BandPart_h

#include "ActiveLevelSetExport.h"
#include "Front/SkinMeasure.h"
#include "Leaves/LeafTable.h"
#include "Ranks/Domain.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace activesurface
{

/** Totals of all ranks, and the numbers of the vertices on this rank. */
struct BandPart
{
  /** Vertices of a leaf: the number of the first vertex in the whole skin, and the crossed edges.
   */
  struct LeafVertices
  {
    NodeIndex Origin;
    std::int64_t First;
    std::array<LeafMask, 3> Edge; //< crossed edges, as in BandLeaf
  };

  std::shared_ptr<const Domain> Space;
  std::size_t Crossings = 0; //< crossed edges of all ranks
  std::size_t ActiveNodes = 0;
  SkinMeasure Measure; //< [voxels^2, voxels^3]
  /** Number of the first vertex of each own leaf that has vertices, in the table's order. */
  std::vector<std::int64_t> FirstVertices;
  std::vector<LeafVertices> Foreign; //< halo leaves that have vertices, by origin

  const Agreement& GetRanks() const { return this->Space->GetRanks(); }
};

/** Sums counts and measures over all ranks, and numbers the vertices. Collective. */
std::shared_ptr<const BandPart> CountTogether(
  const LeafTable& table, const std::shared_ptr<const Domain>& space);

/** Returns, for each vertex of a table, its number in the whole skin. The number is -1 in leaves of
 * other ranks that are not in the halo, and on edges that are not crossed in the owner's copy of
 * the leaf. part: null if the table is whole. */
std::vector<std::int64_t> NumberVertices(const LeafTable& table, const BandPart* part);

}

#endif
