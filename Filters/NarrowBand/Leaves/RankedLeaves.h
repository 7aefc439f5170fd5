/**
 * Leaves that belong to ranks by ranges of the order of the tree: so all ranks know the owner of
 * any leaf, also of one that is added later. Apart from LeafOwners, which the table knows: this
 * exchanges leaves of the table.
 */
#ifndef RankedLeaves_h
#define RankedLeaves_h

#include "Leaves/LeafOwners.h"

namespace activesurface
{

class RankedLeaves final : public LeafOwners
{
public:
  /** Shares the leaves of a table so that each rank has as much to do. */
  RankedLeaves(Agreement& ranks, const LeafTable& table);

  int FindOwner(const openvdb::Coord& origin) const override;
  void AddLeaves(LeafTable& table) override;
  void Renumber(LeafTable& table) override;

private:
  void ShareAll(const LeafTable& table);
  void FindOwners(const LeafTable& table);
  void FindBorders(const LeafTable& table);
  void TellBorders(LeafTable& table, const LeafBorders& borders);

  std::vector<openvdb::Coord> FirstOrigins; //< of the ranks that have leaves
  std::vector<int> OwnersOfRanges;          //< these ranks
};

}

#endif
