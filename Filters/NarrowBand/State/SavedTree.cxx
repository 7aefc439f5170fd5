#include "State/SavedTree.h"

#include "Leaves/LeafFaces.h"
#include "Leaves/LeafTable.h"
#include "OpenVDB.h"

#include <openvdb/tree/ValueAccessor.h>

#include <stdexcept>

namespace activesurface
{

void CheckTree(const openvdb::FloatTree& tree)
{
  const openvdb::FloatGrid::ConstAccessor recent(tree);
  for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf)
  {
    const LeafMask inside = InsideNodes(leaf->buffer().data());
    for (int face = 0; face < 6; ++face)
    {
      const int axis = face / 2, sign = face % 2 ? 1 : -1;
      openvdb::Coord next = leaf->origin();
      next[axis] += sign * 8;
      if (recent.probeConstLeaf(next))
      {
        continue;
      }
      const bool isInside = recent.getValue(next) < 0.f;
      if (TouchesFace(isInside ? LeafMask::All().Without(inside) : inside, axis, sign))
      {
        RefuseState();
      }
    }
  }
}

void RefuseState()
{
  throw std::runtime_error("The saved state is damaged.");
}

}
