/**
 * A band as it was before a substep, for the case that an error ends it half-way.
 */
#ifndef BandBackup_h
#define BandBackup_h

#include "OpenVDB.h"

namespace activesurface
{

class BandBackup
{
public:
  /** Nothing is kept. */
  void Forget() { this->Tree.reset(); }

  /** Keeps the tree as it is, unless one is kept. */
  void Keep(const PotentialTree& tree);

  /** Null if none is kept. */
  openvdb::FloatTree::Ptr Get() const { return this->Tree; }

private:
  openvdb::FloatTree::Ptr Tree;
};

}

#endif
