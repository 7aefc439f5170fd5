#include "Leaves/Layers.h"

#include "Leaves/LayerZero.h"
#include "Leaves/LeafFaces.h"
#include "Leaves/LeafKernels.h"
#include "Leaves/LeafLine.h"

namespace activesurface
{

namespace
{

/** Finds layers 0..m: layers 0..m-1 and their 6-neighbours. */
struct AddLayer
{
  LeafTable& Table;
  int Layer;

  ACTIVE_ALWAYS_INLINE void operator()(std::size_t i) const
  {
    BandLeaf& leaf = this->Table[i];
    LeafMask grown = leaf.UpToLayer[this->Layer - 1];
    this->Grow<0, -1>(leaf, grown);
    this->Grow<0, 1>(leaf, grown);
    this->Grow<1, -1>(leaf, grown);
    this->Grow<1, 1>(leaf, grown);
    this->Grow<2, -1>(leaf, grown);
    this->Grow<2, 1>(leaf, grown);
    leaf.UpToLayer[this->Layer] = grown;
  }

private:
  template <int Axis, int Sign>
  ACTIVE_ALWAYS_INLINE void Grow(BandLeaf& leaf, LeafMask& grown) const
  {
    const LeafMask& inner = leaf.UpToLayer[this->Layer - 1];
    const std::int32_t next = leaf.Neighbour[FaceNumber(Axis, Sign)];
    grown = grown | Seen<Axis, Sign>(inner, this->Table.UpToLayerOf(next, this->Layer - 1));
    if (next < 0 && TouchesFace(inner, Axis, Sign))
    {
      leaf.MissingNeighbours |= 1u << FaceNumber(Axis, Sign);
    }
  }
};

/** Creates the missing neighbours of these leaves. */
LeafList AddMissingLeaves(LeafTable& table, PotentialTree& tree, const LeafList& leaves)
{
  std::vector<openvdb::Coord> missing;
  for (const std::int32_t i : leaves)
  {
    for (std::uint32_t left = table[i].MissingNeighbours; left != 0; left &= left - 1)
    {
      missing.push_back(table[i].OriginOf(LowestBit(left)));
    }
  }
  return table.Add(missing, tree);
}

/** Returns the nodes whose neighbours one and two steps away along the axes are all in the layers.
 */
ACTIVE_ALWAYS_INLINE LeafMask HaveAxisStencil(const LeafTable& table, const BandLeaf& leaf)
{
  const LeafMask& all = leaf.UpToLayer[LastLayer];
  LeafMask complete = all;
  for (int axis = 0; axis < 3; ++axis)
  {
    const LeafMask& next = table.UpToLayerOf(leaf.Neighbour[FaceNumber(axis, 1)], LastLayer);
    const LeafMask& previous = table.UpToLayerOf(leaf.Neighbour[FaceNumber(axis, -1)], LastLayer);
    complete = complete & SeenAhead(all, next, axis, 1) & SeenAhead(all, next, axis, 2) &
      SeenBehind(all, previous, axis, 1) & SeenBehind(all, previous, axis, 2);
  }
  return complete;
}

/** Returns the nodes whose four neighbours on the diagonals between two axes are in the layers. */
template <int A, int B>
ACTIVE_ALWAYS_INLINE LeafMask HaveDiagonals(const LeafTable& table, const BandLeaf& leaf)
{
  const auto inLayers = [&](int number) ACTIVE_INLINED -> const LeafMask&
  { return table.UpToLayerOf(leaf.Neighbour[number], LastLayer); };
  const LeafMask& own = leaf.UpToLayer[LastLayer];
  const LeafMask ahead = Seen<B, 1>(own, inLayers(FaceNumber(B, 1)));
  const LeafMask behind = Seen<B, -1>(own, inLayers(FaceNumber(B, -1)));
  LeafMask complete = LeafMask::All();
  for (const int sign : { -1, 1 })
  {
    const int next = FaceNumber(A, sign);
    const LeafMask& nextMask = inLayers(next);
    const LeafMask nextAhead =
      Seen<B, 1>(nextMask, inLayers(next + FaceNumber(B, 1) - NeighbourNumber(0, 0, 0)));
    const LeafMask nextBehind =
      Seen<B, -1>(nextMask, inLayers(next + FaceNumber(B, -1) - NeighbourNumber(0, 0, 0)));
    complete = complete &
      (sign > 0 ? Seen<A, 1>(ahead, nextAhead) & Seen<A, 1>(behind, nextBehind)
                : Seen<A, -1>(ahead, nextAhead) & Seen<A, -1>(behind, nextBehind));
  }
  return complete;
}

/** Finds the active nodes: layers 0 to 2, and pockets: nodes of larger layers whose stencil is in
 * the layers. */
ACTIVE_ALWAYS_INLINE void FindActiveNodes(LeafTable& table, std::size_t i)
{
  BandLeaf& leaf = table[i];
  leaf.Active = leaf.UpToLayer[LastBandLayer];
  const LeafMask beyond = HaveAxisStencil(table, leaf).Without(leaf.UpToLayer[LastBandLayer]);
  if (beyond.Any())
  {
    leaf.Active = leaf.Active |
      (beyond & HaveDiagonals<0, 1>(table, leaf) & HaveDiagonals<1, 2>(table, leaf) &
        HaveDiagonals<0, 2>(table, leaf));
  }
}

ACTIVE_ALWAYS_INLINE void FindCrossedEdges(LeafTable& table, std::size_t i)
{
  BandLeaf& leaf = table[i];
  leaf.Crossings = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const LeafMask& next = table.InsideOf(leaf.Neighbour[FaceNumber(axis, 1)]);
    leaf.Edge[axis] = leaf.Inside ^ SeenAhead(leaf.Inside, next, axis, 1);
    leaf.CrossingsBefore[axis] = leaf.Crossings;
    leaf.Crossings += leaf.Edge[axis].Count();
  }
}

/** Sets nodes that have left the layers to + or - the background, by their signs. Other nodes
 * outside the layers have + or - the background already. */
ACTIVE_ALWAYS_INLINE void DeactivateNodes(const LeafTable& table, BandLeaf& leaf)
{
  leaf.HoldsStaleValue.Without(leaf.UpToLayer[LastLayer])
    .ForEach(
      [&](int node) ACTIVE_INLINED {
        leaf.Value[node] = table.BackgroundOf(leaf.Inside.Has(node) ? NoLeafInside : NoLeafOutside);
      });
  leaf.HoldsStaleValue = leaf.UpToLayer[LastLayer];
}

/** Finds the crossed edges, active nodes, background values and summary of a leaf. The order of the
 * leaves does not matter. */
struct UseLayers
{
  LeafTable& Table;

  ACTIVE_ALWAYS_INLINE void operator()(std::size_t i) const
  {
    FindCrossedEdges(this->Table, i);
    FindActiveNodes(this->Table, i);
    DeactivateNodes(this->Table, this->Table[i]);
    this->Table.Summarise(i);
  }
};

/** Finds the layers. New leaves change the layers of their neighbour leaves, so the neighbour
 * leaves are searched again. */
void GrowLayers(LeafTable& table, ActiveSet& set, PotentialTree& tree)
{
  LeafList leaves = set.Affected;
  while (!leaves.empty())
  {
    FindLayerZero(table, leaves);
    for (int layer = 1; layer < NumberOfLayers; ++layer)
    {
      ForEachLeaf(table, leaves, AddLayer{ table, layer });
    }
    const LeafList created = AddMissingLeaves(table, tree, leaves);
    set.AddCreated(created);
    leaves = table.FindAround(created);
  }
}

}

void FindLayers(LeafTable& table, ActiveSet& set, PotentialTree& tree)
{
  GrowLayers(table, set, tree);
  table.ForEach(set.Affected, [&](std::size_t i) { FindCrossedEdges(table, i); });
}

void RebuildLayers(LeafTable& table, ActiveSet& set, PotentialTree& tree)
{
  GrowLayers(table, set, tree);
  ForEachLeaf(table, set.Affected, UseLayers{ table });
}

void DropEmptyLeaves(LeafTable& table, PotentialTree& tree)
{
  bool dropped = false;
  for (std::size_t i = 0; i < table.Size(); ++i)
  {
    if (!table.SummaryOf(i).IsUsed)
    {
      const float side = table.BackgroundOf(table[i].Inside.Has(0) ? NoLeafInside : NoLeafOutside);
      tree.addTile(1, table[i].Origin, side, false);
      dropped = true;
    }
  }
  if (dropped)
  {
    table.Rebuild(tree);
  }
}

std::size_t NumberCrossings(LeafTable& table)
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < table.Size(); ++i)
  {
    table[i].FirstCrossing = count;
    count += table[i].Crossings;
  }
  return count;
}

void ReadActiveMasks(LeafTable& table)
{
  table.ForEach(
    [&](std::size_t i)
    {
      const PotentialLeaf::NodeMaskType& mask = table[i].Leaf->getValueMask();
      for (int x = 0; x < 8; ++x)
      {
        table[i].Active.Word[x] = mask.getWord<std::uint64_t>(x);
      }
    });
}

void WriteActiveMasks(const LeafTable& table)
{
  table.ForEach(
    [&](std::size_t i)
    {
      const BandLeaf& leaf = table[i];
      PotentialLeaf::NodeMaskType mask;
      for (int x = 0; x < 8; ++x)
      {
        mask.getWord<std::uint64_t>(x) = leaf.Active.Word[x];
      }
      leaf.Leaf->setValueMask(mask);
    });
}

}
