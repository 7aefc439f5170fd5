/**
 * The leaves that a pass works on. In a substep, all other leaves have converged and are skipped.
 */
#ifndef ActiveSet_h
#define ActiveSet_h

#include "Leaves/LeafTable.h"

namespace activesurface
{

/**
 * Argument of the passes of a substep. Leaves are identified by their numbers in the table, so the
 * set is valid until LeafTable::Rebuild.
 */
struct ActiveSet
{
  LeafList Active;   //< leaves whose potential the substep updates
  LeafList Affected; //< the active leaves, their neighbours, and leaves that the substep creates

  /** Chooses all leaves of the table. */
  void ChooseAll(const LeafTable& table);

  /** Chooses these leaves, with their neighbours as affected leaves. */
  void Choose(const LeafTable& table, LeafList active);

  /** Adds to Affected the leaves that the substep has just created. The numbers of these leaves are
   * above those of all other leaves. */
  void AddCreated(const LeafList& created);
};

}

#endif
