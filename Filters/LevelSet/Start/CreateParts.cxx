#include "Start/CreateParts.h"

#include "Base/Tension.h"

#include "Start/InitialShape.h"
#include "Start/NewParts.h"
#include "Start/PartBand.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace activesurface
{

namespace
{

InitialFunction ValuesOf(const Target& target)
{
  InitialFunction function;
  function.ThreadSafe = target.IsThreadSafe();
  function.Evaluate = [&target](std::size_t count, const double* points, double* values)
  {
    std::vector<double> slopes(count);
    target.Evaluate(count, points, { values, slopes.data() });
  };
  return function;
}

/** A band of only the new parts, or only the new hollows. */
struct NewBand
{
  bool AreHollows;
  LeafSigns Nodes;
  std::unique_ptr<PartBand> Band; // null if there are no nodes

  NewBand(const NewParts& found, bool areHollows)
    : AreHollows(areHollows)
  {
    found.CopyNodes(areHollows, this->Nodes);
    this->Band = this->Nodes.Size() > 0 ? std::make_unique<PartBand>(this->Nodes) : nullptr;
  }
  std::size_t CountActive() const { return this->Band ? this->Band->CountActive() : 0; }
};

/** Computes the union of the body and a part, or the difference of the body and a hollow. A union
 * changes only outside nodes, a difference only inside nodes. */
void JoinLeaf(const BandLeaf& part, bool isHollow, float* values)
{
  constexpr float least = 1e-30f; // keeps the sign
  for (int node = 0; node < 512; ++node)
  {
    const bool isInside = values[node] < 0.f;
    const float distance = part.Value[node];
    if (isInside == isHollow && distance < std::fabs(values[node]))
    {
      const float kept = distance < 0.f ? std::min(distance, -least) : std::max(distance, least);
      values[node] = isInside ? -kept : kept;
    }
  }
}

/** Converts leaves inside the new parts or hollows, far from their surfaces, to tiles of the other
 * sign. */
void JoinTiles(const NewBand& added, PotentialTree& tree)
{
  for (std::size_t i = 0; i < added.Nodes.Size(); ++i)
  {
    const LeafSigns::Leaf& leaf = added.Nodes[i];
    if (leaf.Nodes == LeafMask::All() && added.Band->GetLeaves().Find(leaf.Origin) < 0)
    {
      tree.addTile(1, leaf.Origin, added.AreHollows ? Far : -Far, false);
    }
  }
}

void Join(const NewBand& added, PotentialTree& tree, std::vector<openvdb::Coord>& changed)
{
  if (!added.Band)
  {
    return;
  }
  const LeafTable& parts = added.Band->GetLeaves();
  std::vector<float*> values;
  for (std::size_t i = 0; i < parts.Size(); ++i)
  {
    changed.push_back(parts[i].Origin);
    values.push_back(tree.touchLeaf(parts[i].Origin)->buffer().data());
  }
  JoinTiles(added, tree);
  parts.ForEach([&](std::size_t i) { JoinLeaf(parts[i], added.AreHollows, values[i]); });
}

LeafMask LayersOf(const NewBand& added, const openvdb::Coord& origin)
{
  const std::int32_t i = added.Band ? added.Band->GetLeaves().Find(origin) : -1;
  return i >= 0 ? added.Band->GetLeaves()[i].UpToLayer[LastLayer] : LeafMask();
}

/** Prepares the changed leaves for RebuildLayers and FillGhosts. Nodes in the layers of the new
 * parts and hollows count as updated. */
void MarkChanged(const std::vector<openvdb::Coord>& origins, const NewBand& parts,
  const NewBand& hollows, const GrowingBand& band)
{
  LeafTable& table = band.Leaves;
  LeafList changed;
  for (const openvdb::Coord& origin : origins)
  {
    changed.push_back(table.Find(origin));
  }
  std::sort(changed.begin(), changed.end());
  changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
  band.Set.Choose(table, changed);
  for (const std::int32_t i : band.Set.Affected)
  {
    table[i].Updated = table[i].Active;
  }
  for (const std::int32_t i : table.FindAround(band.Set.Affected))
  {
    table.SummaryOf(i).Speed.IsKnown = false;
  }
  table.ForEach(changed,
    [&](std::size_t i)
    {
      BandLeaf& leaf = table[i];
      leaf.Inside = InsideNodes(leaf.Value);
      leaf.HoldsStaleValue = LeafMask::All();
      leaf.Updated = leaf.Active | LayersOf(parts, leaf.Origin) | LayersOf(hollows, leaf.Origin);
    });
}

void Create(const NewParts& found, const LatticeFunction& function, const GrowingBand& band)
{
  const NewBand parts(found, false), hollows(found, true);
  const std::size_t active =
    band.Leaves.Count([](const LeafSummary& leaf) { return leaf.ActiveNodes; });
  if (active + parts.CountActive() + hollows.CountActive() > band.MaximumNumberOfActiveVoxels)
  {
    RefuseSize(band.MaximumNumberOfActiveVoxels);
  }
  for (const NewBand* added : { &parts, &hollows })
  {
    if (added->Band)
    {
      added->Band->FindDistances(function);
    }
  }
  std::vector<openvdb::Coord> changed;
  band.Backup.Keep(band.Tree);
  Join(parts, band.Tree, changed);
  Join(hollows, band.Tree, changed);
  band.Leaves.Rebuild(band.Tree);
  MarkChanged(changed, parts, hollows, band);
}

}

bool CreateParts(
  const GrowingBand& band, const Motion& motion, const Target& target, AdvanceReport& report)
{
  const InitialFunction values = ValuesOf(target);
  const LatticeFunction function(band.VoxelSize, values);
  const NewParts found(
    { band.Leaves, band.Tree, band.VoxelSize, function, band.MaximumNumberOfActiveVoxels,
      SmallestBall(motion.Tension, motion.Attraction) },
    target);
  const std::size_t count = found.Count();
  if (count > 0)
  {
    Create(found, function, band);
  }
  report.CreatedParts += count;
  report.TargetEvaluations += function.CountEvaluations();
  return count > 0;
}

}
