/**
 * A band of which each rank has a part: its own leaves, and those of other ranks around its space.
 */
#ifndef BandPart_h
#define BandPart_h

#include "ActiveNarrowBandExport.h"
#include "Domain.h"
#include "Leaves/LeafTable.h"
#include "Substep/SkinMeasure.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace activesurface
{

/** Facts of the whole band on a rank. */
struct BandPart
{
  /** Vertices of a leaf: the number of the first one in the whole skin, and their edges. */
  struct LeafVertices
  {
    NodeIndex Origin;
    std::int64_t First;
    std::array<LeafMask, 3> Edge; //< as of BandLeaf
  };

  std::shared_ptr<const Domain> Space;
  std::size_t Crossings = 0; //< of all ranks
  std::size_t ActiveNodes = 0;
  SkinMeasure Measure; //< [voxels]
  /** Of each leaf of this rank that has vertices, in the table's order. */
  std::vector<std::int64_t> FirstVertices;
  std::vector<LeafVertices> Foreign; //< leaves of other ranks, sorted by their origins

  const Agreement& GetRanks() const { return this->Space->GetRanks(); }
};

/** Counts what all ranks have. Collective. */
std::shared_ptr<const BandPart> CountTogether(
  const LeafTable& table, const std::shared_ptr<const Domain>& space);

/** Numbers the vertices of a table as in the whole skin; -1 for those of leaves away from this
 * rank's own. part: null if the table is whole. */
std::vector<std::int64_t> NumberVertices(const LeafTable& table, const BandPart* part);

}

#endif
