#include "Implicit/BandBackup.h"

#include <openvdb/tools/SignedFloodFill.h>

#include <algorithm>

namespace activesurface
{

void BandBackup::Save(const LeafTable& table)
{
  this->Size = table.Size();
  this->Values.MakeRoom(this->Size);
  table.ForEach([&](std::size_t i) { std::copy_n(table[i].Value, 512, this->Values.Of(i)); });
}

void BandBackup::Restore(const LeafTable& table, PotentialTree& tree) const
{
  for (std::size_t i = 0; i < table.Size(); ++i)
  {
    if (i < this->Size)
    {
      std::copy_n(this->Values.Of(i), 512, table[i].Value);
    }
    else
    {
      tree.addTile(1, table[i].Origin, Far, false);
    }
  }
  openvdb::tools::signedFloodFillWithValues(tree, Far, -Far);
}

}
