#include "Leaves/BandBackup.h"

#include "Leaves/LeafExchange.h"

#include <memory>

namespace activesurface
{

void BandBackup::Keep(const LeafTable& table, const PotentialTree& tree)
{
  if (!this->Tree)
  {
    RunTogether(table, [&] { this->Tree = std::make_shared<openvdb::FloatTree>(tree); });
  }
}

}
