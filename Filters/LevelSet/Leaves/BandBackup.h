/**
 * A copy of a band before new parts are created, to restore the band if the substep then throws.
 */
#ifndef BandBackup_h
#define BandBackup_h

#include "Base/OpenVDB.h"

namespace activesurface
{

class BandBackup
{
public:
  void Forget() { this->Tree.reset(); }

  /** Copies the tree unless there is a copy. */
  void Keep(const openvdb::FloatTree& tree);

  openvdb::FloatTree::Ptr Get() const { return this->Tree; }

private:
  openvdb::FloatTree::Ptr Tree;
};

}

#endif
