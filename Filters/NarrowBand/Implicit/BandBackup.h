/**
 * A band as it was before a substep, for the case that an error ends it half-way.
 */
#ifndef BandBackup_h
#define BandBackup_h

#include "Leaves/LeafTable.h"
#include "Substep/SubstepBuffers.h"

namespace activesurface
{

/** Valid until LeafTable::Rebuild. Keeps its memory. */
class BandBackup
{
public:
  void Save(const LeafTable& table);

  /** Writes the values back; leaves that have been added since are tiles again. The layers are left
   * to the caller, as is the table, which may name leaves that are gone. */
  void Restore(LeafTable& table, PotentialTree& tree) const;

private:
  void RemoveAdded(const LeafTable& table, PotentialTree& tree) const;

  NodeArrays Values;
  std::size_t Size = 0;
};

}

#endif
