#include "Start/PartBand.h"

#include "Leaves/Layers.h"
#include "Start/PartDistances.h"

namespace activesurface
{

namespace
{

/** Returns true for an inside leaf next to an outside leaf: no other leaf contains the surface
 * between the two. */
bool IsNextToOutside(const LeafSigns& inside, std::size_t i)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const int sign : { -1, 1 })
    {
      const std::int32_t next = inside.FindNext(i, axis, sign);
      if (next == LeafSigns::None || !inside[next].Nodes.Any())
      {
        return true;
      }
    }
  }
  return false;
}

}

PartBand::PartBand(const LeafSigns& inside)
  : Tree(std::make_shared<openvdb::FloatTree>(Far))
{
  for (std::size_t i = 0; i < inside.Size(); ++i)
  {
    this->AddLeaf(inside, i);
  }
  this->Leaves.SetBackground(Far);
  this->Leaves.Rebuild(*this->Tree);
  ActiveSet set;
  set.ChooseAll(this->Leaves);
  RebuildLayers(this->Leaves, set, *this->Tree);
}

void PartBand::AddLeaf(const LeafSigns& inside, std::size_t i)
{
  const LeafSigns::Leaf& leaf = inside[i];
  if (!leaf.Nodes.Any())
  {
    return;
  }
  if (leaf.Nodes == LeafMask::All() && !IsNextToOutside(inside, i))
  {
    this->Tree->addTile(1, leaf.Origin, -Far, false);
    return;
  }
  float* values = this->Tree->touchLeaf(leaf.Origin)->buffer().data();
  for (int node = 0; node < 512; ++node)
  {
    values[node] = leaf.Nodes.Has(node) ? -Far : Far;
  }
}

std::size_t PartBand::CountActive() const
{
  return this->Leaves.Count([](const LeafSummary& leaf) { return leaf.ActiveNodes; });
}

void PartBand::FindDistances(const LatticeFunction& function)
{
  PartDistances(this->Leaves).Find(function);
}

}
