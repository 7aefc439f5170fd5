/**
 * The leaves that one substep works on. Elsewhere the band has converged and is skipped.
 */
#ifndef ActiveSet_h
#define ActiveSet_h

#include "Leaves/LeafTable.h"

namespace activesurface
{

/**
 * Passes of a substep take this set as an argument. Leaves are known by their numbers in the table,
 * so the set is valid until LeafTable::Rebuild. Choosing anew reuses its memory.
 */
struct ActiveSet
{
  LeafList Active;   //< leaves whose potential the substep updates
  LeafList Affected; //< the active leaves, their neighbours, and leaves that the substep creates

  /** All leaves of the table. */
  void ChooseAll(const LeafTable& table);

  /** These leaves, with their neighbours as affected ones. */
  void Choose(const LeafTable& table, LeafList active);

  /** Leaves that the substep has just created, with numbers above all others. */
  void AddCreated(const LeafList& created);
};

}

#endif
