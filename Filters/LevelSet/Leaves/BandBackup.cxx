#include "Leaves/BandBackup.h"

#include <memory>

namespace activesurface
{

void BandBackup::Keep(const openvdb::FloatTree& tree)
{
  if (!this->Tree)
  {
    this->Tree = std::make_shared<openvdb::FloatTree>(tree);
  }
}

}
