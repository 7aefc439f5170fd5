#include "Start/NewParts.h"

#include "Leaves/LeafFaces.h"

namespace activesurface
{

namespace
{

/** Adds to `grown` all nodes of `nodes` that edges connect with `grown`. waiting: leaves from which
 * to grow. */
void Grow(const LeafSigns& nodes, LeafList waiting, std::vector<LeafMask>& grown)
{
  while (!waiting.empty())
  {
    const std::int32_t i = waiting.back();
    waiting.pop_back();
    grown[i] = GrowInLeaf(grown[i], nodes[i].Nodes);
    for (int face = 0; face < 6; ++face)
    {
      const int axis = face / 2, sign = face % 2 ? 1 : -1;
      const std::int32_t next = nodes.FindNext(i, axis, sign);
      if (next == LeafSigns::None || !TouchesFace(grown[i], axis, sign))
      {
        continue;
      }
      const LeafMask added =
        (SeenAcross(grown[i], axis, sign) & nodes[next].Nodes).Without(grown[next]);
      if (added.Any())
      {
        grown[next] = grown[next] | added;
        waiting.push_back(next);
      }
    }
  }
}

}

NewParts::NewParts(const PartSearch& search, const Target& target)
{
  PartSeeds seeds(search, this->Nodes);
  seeds.AddRegions(target);
  target.ForEachPart([&](const TargetPart& part) { seeds.AddPart(part); });
  for (std::size_t begin = 0; begin < this->Nodes.Size();)
  {
    const std::size_t end = this->Nodes.Size();
    RefuseManyLeaves(static_cast<double>(end), search.MaximumNumberOfActiveVoxels);
    this->Reached.resize(end);
    this->Inside.resize(end);
    search.Target.ForEach(begin, end, [&](std::size_t i) { this->SampleLeaf(search, i); });
    this->FindReached(begin);
    this->AddNext(begin, end);
    begin = end;
  }
  for (std::size_t i = 0; i < this->Nodes.Size(); ++i)
  {
    this->Nodes[i].Nodes = this->Nodes[i].Nodes.Without(this->Reached[i]);
  }
  this->RemoveNarrowHollows(search.GetLeastSteps());
}

void NewParts::SampleLeaf(const PartSearch& search, std::size_t i)
{
  LeafSigns::Leaf& leaf = this->Nodes[i];
  const SkinLeaf skin(search, leaf.Origin);
  double values[512];
  search.Target.Evaluate(leaf.Origin, LeafMask::All(), values);
  for (int node = 0; node < 512; ++node)
  {
    if (Differs(values[node], skin.Inside->Has(node)))
    {
      leaf.Nodes.Add(node);
    }
  }
  this->Reached[i] = leaf.Nodes & *skin.LayerZero;
  this->Inside[i] = *skin.Inside;
}

void NewParts::FindReached(std::size_t first)
{
  LeafList waiting;
  const auto add = [&](std::int32_t i)
  {
    if (i != LeafSigns::None && this->Reached[i].Any())
    {
      waiting.push_back(i);
    }
  };
  for (std::size_t i = first; i < this->Nodes.Size(); ++i)
  {
    add(static_cast<std::int32_t>(i));
    for (int face = 0; face < 6; ++face)
    {
      add(this->Nodes.FindNext(i, face / 2, face % 2 ? 1 : -1));
    }
  }
  Grow(this->Nodes, waiting, this->Reached);
}

/** Adds the leaves across the faces that new parts touch, for leaves begin to end - 1. */
void NewParts::AddNext(std::size_t begin, std::size_t end)
{
  for (std::size_t i = begin; i < end; ++i)
  {
    const LeafMask parts = this->Nodes[i].Nodes.Without(this->Reached[i]);
    for (int face = 0; face < 6; ++face)
    {
      const int axis = face / 2, sign = face % 2 ? 1 : -1;
      if (TouchesFace(parts, axis, sign))
      {
        this->Nodes.Add(this->Nodes.OriginOfNext(i, axis, sign));
      }
    }
  }
}

/** Keeps a hollow only if one of its nodes is wide: the six nodes `steps` away along the axes also
 * belong to new parts or hollows. */
void NewParts::RemoveNarrowHollows(int steps)
{
  std::vector<LeafMask> kept(this->Nodes.Size());
  LeafList withKept;
  for (std::size_t i = 0; i < this->Nodes.Size(); ++i)
  {
    const LeafMask& nodes = this->Nodes[i].Nodes;
    kept[i] = nodes.Without(this->Inside[i]);
    (nodes & this->Inside[i])
      .ForEach(
        [&](int node)
        {
          if (this->IsWide(
                this->Nodes[i].Origin.offsetBy(node >> 6, (node >> 3) & 7, node & 7), steps))
          {
            kept[i].Add(node);
          }
        });
    if (kept[i].Any())
    {
      withKept.push_back(static_cast<std::int32_t>(i));
    }
  }
  Grow(this->Nodes, withKept, kept);
  for (std::size_t i = 0; i < this->Nodes.Size(); ++i)
  {
    this->Nodes[i].Nodes = kept[i];
  }
}

bool NewParts::IsWide(const openvdb::Coord& node, int steps) const
{
  for (int face = 0; face < 6; ++face)
  {
    openvdb::Coord next = node;
    next[face / 2] += face % 2 ? steps : -steps;
    if (!this->Nodes.Has(next))
    {
      return false;
    }
  }
  return true;
}

void NewParts::CopyNodes(bool areInside, LeafSigns& nodes) const
{
  for (std::size_t i = 0; i < this->Nodes.Size(); ++i)
  {
    const LeafMask& all = this->Nodes[i].Nodes;
    const LeafMask copied = areInside ? all & this->Inside[i] : all.Without(this->Inside[i]);
    if (copied.Any())
    {
      nodes[nodes.Add(this->Nodes[i].Origin)].Nodes = copied;
    }
  }
}

std::size_t NewParts::Count() const
{
  std::size_t count = 0;
  std::vector<LeafMask> counted(this->Nodes.Size());
  for (std::size_t i = 0; i < this->Nodes.Size(); ++i)
  {
    this->Nodes[i].Nodes.ForEach(
      [&](int node)
      {
        if (!counted[i].Has(node))
        {
          counted[i].Add(node);
          Grow(this->Nodes, { static_cast<std::int32_t>(i) }, counted);
          ++count;
        }
      });
  }
  return count;
}

}
