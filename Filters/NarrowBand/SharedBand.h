/**
 * A band that ranks advance together, with its target: who has which leaves, and so at which places
 * asks for the target.
 */
#ifndef SharedBand_h
#define SharedBand_h

#include "Leaves/LeafTable.h"
#include "Leaves/RankedLeaves.h"
#include "Parts/OwnLeaves.h"
#include "Target.h"

namespace activesurface
{

/** As long as it exists, ranks share the leaves of a table, and a target is kept near their own. */
class SharedBand
{
public:
  SharedBand(Agreement& ranks, LeafTable& table, Target& target, double voxelSize)
    : Table(table)
    , Kept(target)
    , Owners(ranks, table)
    , Places(this->Owners, voxelSize)
  {
    table.SetRanks(&this->Owners);
    target.KeepNear(&this->Places);
  }
  ~SharedBand()
  {
    this->Kept.KeepNear(nullptr);
    this->Table.SetRanks(nullptr);
  }
  SharedBand(const SharedBand&) = delete;
  void operator=(const SharedBand&) = delete;

private:
  LeafTable& Table;
  Target& Kept;
  RankedLeaves Owners;
  const OwnLeaves Places;
};

}

#endif
