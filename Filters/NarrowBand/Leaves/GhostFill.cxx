#include "Leaves/GhostFill.h"

#include "Leaves/LayerFill.h"
#include "Leaves/LeafExchange.h"
#include "Leaves/LeafKernels.h"
#include "Leaves/LeafLists.h"

#include <cmath>

namespace activesurface
{

namespace
{

/** Nodes of a layer whose value is not the last substep's: ghosts, and those that entered, which
 * only affected leaves can have. */
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
  bool IsAffected; //< whether the leaves are

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

/** A pass that sets values of its layer; those beside these leaves are told. */
template <class Kernel>
void SetValues(LeafTable& table, const LeafList& leaves, const Kernel& kernel)
{
  ForEachLeaf(table, leaves, kernel);
  TellNeighbours(table, leaves,
    [&table, &kernel](std::size_t i, auto& pass)
    {
      const BandLeaf& leaf = table[i];
      PassNodes(
        leaf.Value, leaf.UpToLayer[kernel.Layer].Without(leaf.UpToLayer[kernel.Layer - 1]), pass);
    });
}

// Three-point rays over three layers end up to nine nodes from what has moved.
void FillBesideAffected(LeafTable& table, const ActiveSet& set)
{
  const LeafList beyond = Without(table.FindAround(set.Affected), set.Affected);
  SetValues(table, beyond, FillLayer{ table, LastLayer, false });
}

}

void FillGhosts(LeafTable& table, const ActiveSet& set)
{
  for (int layer = 1; layer <= LastLayer; ++layer)
  {
    SetValues(table, set.Affected, FillLayer{ table, layer, true });
  }
  FillBesideAffected(table, set);
}

}
