#include "Parts/NewParts.h"

#include "Leaves/LeafFaces.h"

#include <cmath>

namespace activesurface
{

namespace
{

const LeafMask Nothing;

/** The potential in a leaf of the lattice, of the band's or not. */
struct SkinLeaf
{
  const LeafMask* Inside;
  const LeafMask* LayerZero;

  SkinLeaf(const NewParts::Search& search, const openvdb::Coord& origin)
  {
    static const LeafMask everything = LeafMask::All();
    const std::int32_t leaf = search.Skin.Find(origin);
    this->LayerZero = leaf >= 0 ? &search.Skin[leaf].UpToLayer[0] : &Nothing;
    this->Inside = leaf >= 0                    ? &search.Skin[leaf].Inside
      : search.Potential.getValue(origin) < 0.f ? &everything
                                                : &Nothing;
  }
};

bool Differs(double target, bool isInside)
{
  return !std::isnan(target) && (target < 0.0) != isInside;
}

openvdb::Coord OriginOf(const openvdb::Coord& node)
{
  return openvdb::Coord(node[0] & ~7, node[1] & ~7, node[2] & ~7);
}

int NumberOf(const openvdb::Coord& node)
{
  return (node[0] & 7) << 6 | (node[1] & 7) << 3 | (node[2] & 7);
}

/** The node nearest to the centre of a region; false if there is none. */
bool FindCentre(const TargetRegion& region, double voxelSize, openvdb::Coord& node)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const double low = region.Bounds[2 * axis], high = region.Bounds[2 * axis + 1];
    const double centre = (.5 * low + .5 * high) / voxelSize;
    if (!(low <= high) || !(std::fabs(centre) < FarthestNode))
    {
      return false;
    }
    node[axis] = static_cast<int>(std::floor(centre + .5));
  }
  return true;
}

/** Adds the nodes next to these, within the nodes of their leaf. */
LeafMask GrowInLeaf(const LeafMask& from, const LeafMask& nodes)
{
  LeafMask grown = from, before;
  do
  {
    before = grown;
    for (int axis = 0; axis < 3; ++axis)
    {
      grown = grown | SeenAhead(grown, Nothing, axis, 1) | SeenBehind(grown, Nothing, axis, 1);
    }
    grown = grown & nodes;
  } while (!(grown == before));
  return grown;
}

/** Adds to `grown` what is connected with it within the nodes, along edges. waiting: the leaves of
 * what is to be added to. */
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
      const LeafMask across =
        sign > 0 ? SeenBehind(Nothing, grown[i], axis, 1) : SeenAhead(Nothing, grown[i], axis, 1);
      const LeafMask added = (across & nodes[next].Nodes).Without(grown[next]);
      if (added.Any())
      {
        grown[next] = grown[next] | added;
        waiting.push_back(next);
      }
    }
  }
}

}

NewParts::NewParts(const Search& search, const ForEachRegion& forEachRegion)
{
  this->AddSeeds(search, forEachRegion);
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
}

void NewParts::AddSeeds(const Search& search, const ForEachRegion& forEachRegion)
{
  std::vector<openvdb::Coord> centres;
  forEachRegion(
    [&](const TargetRegion& region)
    {
      openvdb::Coord node;
      if (region.Seeds == RegionSeeds::AllNodes)
      {
        this->Nodes.AddRegion(
          region, search.VoxelSize, nullptr, search.MaximumNumberOfActiveVoxels);
      }
      else if (FindCentre(region, search.VoxelSize, node))
      {
        const SkinLeaf skin(search, OriginOf(node));
        const bool isCovered =
          region.Seeds == RegionSeeds::PartAtCentre && skin.Inside->Has(NumberOf(node));
        if (!isCovered && !skin.LayerZero->Has(NumberOf(node)))
        {
          centres.push_back(node);
        }
      }
    });
  std::vector<double> values;
  search.Target.Evaluate(centres, values);
  for (std::size_t i = 0; i < centres.size(); ++i)
  {
    const openvdb::Coord origin = OriginOf(centres[i]);
    if (Differs(values[i], SkinLeaf(search, origin).Inside->Has(NumberOf(centres[i]))))
    {
      this->Nodes.Add(origin);
    }
  }
}

void NewParts::SampleLeaf(const Search& search, std::size_t i)
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

/** The leaves across the faces at which new parts are, of those from begin to end - 1. */
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
