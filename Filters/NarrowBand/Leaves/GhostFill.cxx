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

/** Where substeps are long, ghosts at medial axes that grew faster would drive each other on. */
constexpr float MostGrowthOfLongSteps = 2.f;

ACTIVE_ALWAYS_INLINE void SetMagnitude(BandLeaf& leaf, int node, float magnitude)
{
  leaf.Value[node] = leaf.Inside.Has(node) ? -magnitude : magnitude;
}

struct FillLayer
{
  LeafTable& Table;
  int Layer;
  bool IsAffected; //< whether the leaves are
  float MostGrowth;

  ACTIVE_ALWAYS_INLINE void operator()(std::size_t i) const
  {
    BandLeaf& leaf = this->Table[i];
    const LeafMask nodes = NodesToFill(leaf, this->IsAffected, this->Layer);
    if (!nodes.Any())
    {
      return;
    }
    LayerFill<false>(this->Table, i, this->Layer, this->MostGrowth)
      .ForEach(nodes,
        [&leaf](int node, float magnitude) ACTIVE_INLINED { SetMagnitude(leaf, node, magnitude); });
  }
};

struct FillOldLayer
{
  LeafTable& Table;
  int Layer;

  ACTIVE_ALWAYS_INLINE void operator()(std::size_t i) const
  {
    BandLeaf& leaf = this->Table[i];
    const LeafMask nodes = NodesToFill(leaf, false, this->Layer);
    if (!nodes.Any())
    {
      return;
    }
    LayerFill<true>(this->Table, i, this->Layer, MostGrowthOfLongSteps)
      .ForEach(nodes,
        [&leaf](int node, float magnitude) ACTIVE_INLINED { SetMagnitude(leaf, node, magnitude); });
  }
};

/** The nodes of a layer that have entered the band. */
ACTIVE_ALWAYS_INLINE LeafMask EnteredNodes(const BandLeaf& leaf, int layer)
{
  return NodesToFill(leaf, true, layer) & leaf.Active;
}

/** The first sweep, and the ghosts. */
struct FillAndSolveLayer
{
  LeafTable& Table;
  int Layer;

  ACTIVE_ALWAYS_INLINE void operator()(std::size_t i) const
  {
    BandLeaf& leaf = this->Table[i];
    const LeafMask nodes = NodesToFill(leaf, true, this->Layer);
    if (!nodes.Any())
    {
      return;
    }
    const LeafMask entered = EnteredNodes(leaf, this->Layer);
    LayerFill<false> fill(this->Table, i, this->Layer, HUGE_VALF);
    const auto set = [&leaf](int node, float magnitude) ACTIVE_INLINED
    { SetMagnitude(leaf, node, magnitude); };
    fill.ForEach(nodes.Without(entered), set);
    entered.ForEach([&](int node) ACTIVE_INLINED { set(node, fill.FindEikonal(node)); });
  }
};

/** The second sweep, which leaves its values in the room. */
struct SolveLayerAgain
{
  const LeafTable& Table;
  int Layer;
  const NodeArrays& Room;

  ACTIVE_ALWAYS_INLINE void operator()(std::size_t i) const
  {
    const LayerFill<false> fill(this->Table, i, this->Layer + 1, HUGE_VALF);
    EnteredNodes(this->Table[i], this->Layer)
      .ForEach([&](int node) ACTIVE_INLINED { this->Room.Of(i)[node] = fill.FindEikonal(node); });
  }
};

struct TakeLayer
{
  LeafTable& Table;
  int Layer;
  const NodeArrays& Room;

  ACTIVE_ALWAYS_INLINE void operator()(std::size_t i) const
  {
    BandLeaf& leaf = this->Table[i];
    EnteredNodes(leaf, this->Layer)
      .ForEach([&](int node) ACTIVE_INLINED { SetMagnitude(leaf, node, this->Room.Of(i)[node]); });
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
void FillBesideAffected(LeafTable& table, const ActiveSet& set, float mostGrowth)
{
  const LeafList beyond = Without(table.FindAround(set.Affected), set.Affected);
  SetValues(table, beyond, FillLayer{ table, LastLayer, false, mostGrowth });
}

}

void FillGhosts(LeafTable& table, const ActiveSet& set, float mostGrowth)
{
  for (int layer = 1; layer <= LastLayer; ++layer)
  {
    SetValues(table, set.Affected, FillLayer{ table, layer, true, mostGrowth });
  }
  FillBesideAffected(table, set, mostGrowth);
}

void FillGhostsAndEntered(LeafTable& table, const ActiveSet& set, NodeArrays& room)
{
  room.MakeRoom(table);
  for (int layer = 1; layer <= LastLayer; ++layer)
  {
    SetValues(table, set.Affected, FillAndSolveLayer{ table, layer });
    ForEachLeaf(table, set.Affected, SolveLayerAgain{ table, layer, room });
    SetValues(table, set.Affected, TakeLayer{ table, layer, room });
  }
  FillBesideAffected(table, set, HUGE_VALF);
}

void FillGhostsOfOldLayers(LeafTable& table, const ActiveSet& set)
{
  for (int layer = LastBandLayer + 1; layer <= LastLayer; ++layer)
  {
    SetValues(table, set.Affected, FillOldLayer{ table, layer });
  }
  const LeafList beyond = Without(table.FindAround(set.Affected), set.Affected);
  SetValues(table, beyond, FillOldLayer{ table, LastLayer });
}

}
