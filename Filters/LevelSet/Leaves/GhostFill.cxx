#include "Leaves/GhostFill.h"

#include "Leaves/LayerFill.h"
#include "Leaves/LeafKernels.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace activesurface
{

namespace
{

/** Nodes of a layer that the last substep has not updated: ghosts, and nodes that entered the band.
 * Only affected leaves can have the latter. */
ACTIVE_ALWAYS_INLINE LeafMask NodesToFill(const BandLeaf& leaf, bool isAffected, int layer)
{
  const LeafMask valid = isAffected ? leaf.Active & leaf.Updated : leaf.Active;
  return leaf.UpToLayer[layer].Without(leaf.UpToLayer[layer - 1]).Without(valid);
}

ACTIVE_ALWAYS_INLINE void SetMagnitude(BandLeaf& leaf, int node, float magnitude)
{
  leaf.Value[node] = leaf.Inside.Has(node) ? -magnitude : magnitude;
}

struct FillLayer
{
  LeafTable& Table;
  int Layer;
  bool IsAffected; //< whether the leaves are affected

  ACTIVE_ALWAYS_INLINE void operator()(std::size_t i) const
  {
    BandLeaf& leaf = this->Table[i];
    const LeafMask nodes = NodesToFill(leaf, this->IsAffected, this->Layer);
    if (!nodes.Any())
    {
      return;
    }
    LayerFill(this->Table, i, this->Layer)
      .ForEach(nodes,
        [&leaf](int node, float magnitude) ACTIVE_INLINED { SetMagnitude(leaf, node, magnitude); });
  }
};

LeafList Without(const LeafList& leaves, const LeafList& others)
{
  LeafList rest;
  std::set_difference(
    leaves.begin(), leaves.end(), others.begin(), others.end(), std::back_inserter(rest));
  return rest;
}

// Three-point rays over three layers end up to nine nodes from an updated node: beyond the affected
// leaves.
void FillBesideAffected(LeafTable& table, const ActiveSet& set)
{
  const LeafList beyond = Without(table.FindAround(set.Affected), set.Affected);
  ForEachLeaf(table, beyond, FillLayer{ table, LastLayer, false });
}

}

void FillGhosts(LeafTable& table, const ActiveSet& set)
{
  for (int layer = 1; layer <= LastLayer; ++layer)
  {
    ForEachLeaf(table, set.Affected, FillLayer{ table, layer, true });
  }
  FillBesideAffected(table, set);
}

}
