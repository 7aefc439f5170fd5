#include "State/SavedTree.h"

#include "OpenVDB.h"

#include "Leaves/LeafFaces.h"
#include "Leaves/LeafTable.h"

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
      const bool isTile = !recent.probeConstLeaf(next);
      const LeafMask others =
        recent.getValue(next) < 0.f ? LeafMask::All().Without(inside) : inside;
      if (isTile && TouchesFace(others, axis, sign))
      {
        throw std::runtime_error("The saved state is damaged.");
      }
    }
  }
}

}
