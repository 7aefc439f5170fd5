/**
 * A band as it was before a substep, for the case that an error ends it half-way.
 */
#ifndef BandBackup_h
#define BandBackup_h

#include "Leaves/LeafTable.h"
#include "Leaves/NodeArrays.h"

#include <vector>

namespace activesurface
{

/** Keeps its memory, but for the tree. */
class BandBackup
{
public:
  void Save(const LeafTable& table);
  /** Nothing is saved. */
  void Forget();

  /** To be called, on all ranks, before LeafTable::Rebuild: what has been saved goes by the leaves'
   * numbers. Where nothing has been, the tree itself is kept, as it is. */
  void KeepAsTree(const LeafTable& table, const PotentialTree& tree);

  /** The tree as it was, or null if nothing is saved: this one, if there is no other, with its
   * values of then; leaves that have been added since are tiles again. The layers are left to the
   * caller, as is the table, which may name leaves that are gone. */
  openvdb::FloatTree::Ptr Restore(
    const LeafTable& table, const openvdb::FloatTree::Ptr& tree) const;

private:
  void WriteInto(PotentialTree& tree, const LeafTable& table) const;
  void RemoveAdded(
    PotentialTree& tree, const LeafTable& table, const std::vector<float*>& values) const;

  NodeArrays Values;
  std::size_t Size = 0;
  openvdb::FloatTree::Ptr Tree; //< instead of the values, if there is one
};

}

#endif
