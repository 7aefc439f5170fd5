/**
 * Leaves that belong to ranks by ranges of their Morton order: so all ranks know the owner of any
 * leaf, also of one that is added later, and what a rank has is compact. Apart from LeafOwners,
 * which the table knows: this exchanges leaves of the table.
 */
#ifndef RankedLeaves_h
#define RankedLeaves_h

#include "Leaves/LeafOwners.h"

namespace activesurface
{

/** Whether a leaf comes before another one, by their origins. */
bool AreLeavesInOrder(const openvdb::Coord& a, const openvdb::Coord& b);

class RankedLeaves final : public LeafOwners
{
public:
  /** Shares the leaves of a table so that each rank has as much to do. */
  RankedLeaves(Agreement& ranks, const LeafTable& table);
  /** The same where there is no table yet: as many leaves, by their origins in order, for each
   * rank, see RankRanges. */
  RankedLeaves(Agreement& ranks, const std::vector<openvdb::Coord>& origins);

  int FindOwner(const openvdb::Coord& origin) const override;
  void AddLeaves(LeafTable& table) override;
  void Renumber(LeafTable& table) override;

private:
  void ShareAll(const LeafTable& table);
  void FindOwners(const LeafTable& table);
  void FindBorders(const LeafTable& table);
  void FindSlots(const LeafTable& table);
  void TellBorders(LeafTable& table, const LeafBorders& borders);

  std::vector<openvdb::Coord> FirstOrigins; //< of the ranks that have leaves
  std::vector<int> OwnersOfRanges;          //< these ranks
};

}

#endif
