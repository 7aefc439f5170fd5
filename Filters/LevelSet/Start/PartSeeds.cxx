#include "Start/PartSeeds.h"

#include "Start/LatticeBox.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace activesurface
{

namespace
{

/** Finds the node nearest to a point. Returns false if the point is not finite or too far from 0.
 */
bool FindNode(const double x[3], double voxelSize, openvdb::Coord& node)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const double place = x[axis] / voxelSize;
    if (!(std::fabs(place) < FarthestNode))
    {
      return false;
    }
    node[axis] = static_cast<int>(std::floor(place + .5));
  }
  return true;
}

/** Finds the node nearest to the centre of a region. Returns false if the region is empty, not
 * finite or too far from 0. */
bool FindCentre(const TargetRegion& region, double voxelSize, openvdb::Coord& node)
{
  double centre[3];
  bool isThere = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double low = region.Bounds[2 * axis], high = region.Bounds[2 * axis + 1];
    centre[axis] = .5 * low + .5 * high;
    isThere = isThere && low <= high;
  }
  return isThere && FindNode(centre, voxelSize, node);
}

}

int PartSearch::GetLeastSteps() const
{
  constexpr double most = 1e6;
  return static_cast<int>(
    std::ceil(std::min(std::max(this->LeastRadius / this->VoxelSize, 1.0), most)));
}

SkinLeaf::SkinLeaf(const PartSearch& search, const openvdb::Coord& origin)
{
  static const LeafMask nothing, everything = LeafMask::All();
  const std::int32_t leaf = search.Skin.Find(origin);
  this->LayerZero = leaf >= 0 ? &search.Skin[leaf].UpToLayer[0] : &nothing;
  this->Inside = leaf >= 0                    ? &search.Skin[leaf].Inside
    : search.Potential.getValue(origin) < 0.f ? &everything
                                              : &nothing;
}

void PartSeeds::AddRegions(const Target& target)
{
  const Candidates found = this->SearchAll(target);
  for (const TargetRegion& box : found.Boxes)
  {
    this->Leaves.AddRegion(
      box, this->Search.VoxelSize, nullptr, this->Search.MaximumNumberOfActiveVoxels);
  }
  for (const openvdb::Coord& leaf : this->FindLeaves(found.Centres))
  {
    this->Leaves.Add(leaf);
  }
}

PartSeeds::Candidates PartSeeds::SearchAll(const Target& target) const
{
  constexpr std::size_t atOnce = 4096;
  const std::size_t sources = target.CountRegionSources();
  std::vector<Candidates> found((sources + atOnce - 1) / atOnce);
  tbb::parallel_for(std::size_t(0), found.size(),
    [&](std::size_t i)
    {
      target.VisitRegions(i * atOnce, std::min((i + 1) * atOnce, sources),
        [&](const TargetRegion& region) { this->SearchRegion(region, found[i]); });
    });
  Candidates all;
  for (const Candidates& some : found)
  {
    all.Boxes.insert(all.Boxes.end(), some.Boxes.begin(), some.Boxes.end());
    all.Centres.insert(all.Centres.end(), some.Centres.begin(), some.Centres.end());
  }
  return all;
}

void PartSeeds::SearchRegion(const TargetRegion& region, Candidates& found) const
{
  openvdb::Coord node;
  if (region.Seeds == RegionSeeds::AllNodes)
  {
    found.Boxes.push_back(region);
  }
  else if (FindCentre(region, this->Search.VoxelSize, node))
  {
    const SkinLeaf skin(this->Search, OriginOfLeaf(node));
    const bool isInside = skin.Inside->Has(NumberInLeaf(node));
    const bool isCovered =
      region.Seeds == (isInside ? RegionSeeds::PartAtCentre : RegionSeeds::HollowAtCentre);
    if (!isCovered && !skin.LayerZero->Has(NumberInLeaf(node)))
    {
      found.Centres.push_back(node);
    }
  }
}

PartSeeds::Nodes PartSeeds::FindLeaves(const Nodes& centres) const
{
  std::vector<double> values;
  this->Search.Target.Evaluate(centres, values);
  Nodes leaves;
  for (std::size_t i = 0; i < centres.size(); ++i)
  {
    if (Differs(values[i], this->IsInside(centres[i])))
    {
      leaves.push_back(OriginOfLeaf(centres[i]));
    }
  }
  std::sort(leaves.begin(), leaves.end());
  leaves.erase(std::unique(leaves.begin(), leaves.end()), leaves.end());
  return leaves;
}

bool PartSeeds::IsInside(const openvdb::Coord& node) const
{
  return SkinLeaf(this->Search, OriginOfLeaf(node)).Inside->Has(NumberInLeaf(node));
}

void PartSeeds::AddPart(const TargetPart& part)
{
  Nodes nodes;
  bool isMet = false;
  const PointVisitor meet = [&](const double x[3])
  {
    openvdb::Coord node;
    if (FindNode(x, this->Search.VoxelSize, node))
    {
      nodes.push_back(node);
      isMet = this->IsInside(node) != part.IsHollow();
    }
    return !isMet;
  };
  part.ForEachSample(meet);
  if (isMet)
  {
    return;
  }
  const Nodes seeds = this->FindMissing(nodes, part.IsHollow());
  if (!seeds.empty())
  {
    nodes.clear();
    part.ForEachPoint(meet);
  }
  for (std::size_t i = 0; !isMet && i < seeds.size(); ++i)
  {
    this->Leaves.Add(OriginOfLeaf(seeds[i]));
  }
}

/** Returns the nodes in a part of the target, or in a hollow if areHollow, where the part or hollow
 * is wide (IsWide). */
PartSeeds::Nodes PartSeeds::FindMissing(const Nodes& nodes, bool areHollow) const
{
  std::vector<double> values;
  this->Search.Target.Evaluate(nodes, values);
  Nodes missing;
  for (std::size_t i = 0; i < nodes.size(); ++i)
  {
    if (Differs(values[i], areHollow) && this->IsWide(nodes[i], areHollow))
    {
      missing.push_back(nodes[i]);
    }
  }
  return missing;
}

/** Returns true if the six nodes GetLeastSteps() from `node` along the axes are inside the target,
 * or outside if isHollow. */
bool PartSeeds::IsWide(const openvdb::Coord& node, bool isHollow) const
{
  const int steps = this->Search.GetLeastSteps();
  Nodes around;
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const int sign : { -1, 1 })
    {
      openvdb::Coord next = node;
      next[axis] += sign * steps;
      around.push_back(next);
    }
  }
  std::vector<double> values;
  this->Search.Target.Evaluate(around, values);
  return std::all_of(
    values.begin(), values.end(), [isHollow](double value) { return Differs(value, isHollow); });
}

}
