#include "State/SavedTree.h"

#include "Base/OpenVDB.h"
#include "Leaves/LeafFaces.h"
#include "Leaves/LeafTable.h"

#include <openvdb/tree/ValueAccessor.h>

#include <algorithm>
#include <stdexcept>

namespace activesurface
{

namespace
{

/** Returns true beyond 2^30 nodes. No surface gets there, and coordinates of neighbours would
 * overflow. */
bool IsTooFar(const openvdb::Coord& origin)
{
  constexpr int farthest = 1 << 30;
  return std::any_of(origin.data(), origin.data() + 3,
    [](int coordinate) { return coordinate < -farthest || coordinate > farthest; });
}

}

void CheckTree(const openvdb::FloatTree& tree)
{
  const openvdb::FloatGrid::ConstAccessor recent(tree);
  for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf)
  {
    if (IsTooFar(leaf->origin()))
    {
      RefuseState();
    }
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
