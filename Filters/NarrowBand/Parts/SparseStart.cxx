#include "Parts/SparseStart.h"

#include "Leaves/LeafFaces.h"
#include "Leaves/RankedLeaves.h"
#include "Parts/LatticeFunction.h"
#include "Parts/LeafSigns.h"
#include "Parts/OwnLeaves.h"
#include "Parts/PartBand.h"
#include "SharedResults.h"
#include "State/InitialShape.h"
#include "State/LatticeBox.h"

#include <algorithm>
#include <array>
#include <memory>
#include <vector>

namespace activesurface
{

namespace
{

/** Which rank evaluates the function in which leaves. */
struct SharedStart
{
  RankedLeaves Owners;
  OwnLeaves Places;

  SharedStart(Agreement& ranks, const std::vector<openvdb::Coord>& origins, double voxelSize)
    : Owners(ranks, origins)
    , Places(this->Owners, voxelSize)
  {
  }
};

/** The origins of the leaves of all ranks, in order. */
std::vector<openvdb::Coord> GatherOrigins(Agreement& ranks, const LeafSigns& own)
{
  std::vector<std::array<int, 3>> told;
  for (std::size_t i = 0; i < own.Size(); ++i)
  {
    const openvdb::Coord& origin = own[i].Origin;
    told.push_back({ origin[0], origin[1], origin[2] });
  }
  std::vector<openvdb::Coord> origins;
  for (const std::array<int, 3>& origin : GatherLists(ranks, told))
  {
    origins.emplace_back(origin[0], origin[1], origin[2]);
  }
  std::sort(origins.begin(), origins.end(), AreLeavesInOrder);
  origins.erase(std::unique(origins.begin(), origins.end()), origins.end());
  return origins;
}

/** The leaves of the regions of this rank; with ranks, of those of all ranks, each of which has a
 * range of them. */
std::shared_ptr<SharedStart> AddLeaves(const InitialFunction& function, double voxelSize,
  const LatticeBox& box, std::size_t maximum, Agreement* ranks, LeafSigns& leaves)
{
  LeafSigns own;
  LeafSigns& ofRegions = ranks ? own : leaves;
  function.ForEachRegion(
    [&](const TargetRegion& region) { ofRegions.AddRegion(region, voxelSize, &box, maximum); });
  if (!ranks)
  {
    return nullptr;
  }
  const std::vector<openvdb::Coord> origins = GatherOrigins(*ranks, own);
  for (const openvdb::Coord& origin : origins)
  {
    leaves.Add(origin);
  }
  RefuseManyLeaves(static_cast<double>(leaves.Size()), maximum);
  auto shared = std::make_shared<SharedStart>(*ranks, origins, voxelSize);
  if (function.KeepNear)
  {
    function.KeepNear(std::shared_ptr<const OwnPlaces>(shared, &shared->Places));
  }
  return shared;
}

/** False when `progress` stopped it. */
bool SampleInside(const LatticeFunction& function, const ProgressFunction& progress,
  Agreement* ranks, LeafSigns& leaves)
{
  constexpr std::size_t atOnce = 1024;
  const auto size = static_cast<std::size_t>(ranks ? ranks->GetSize() : 1);
  const std::size_t most = RankRanges{ leaves.Size(), size }.FirstOf(1); // that a rank has
  bool goesOn = true;
  ShareResults(
    ranks, leaves.Size(),
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t done = 0; done < most && goesOn; done += atOnce) // on all ranks as often
      {
        goesOn = !progress || progress(double(done) / double(most));
        function.ForEach(std::min(begin + done, end),
          goesOn ? std::min(begin + done + atOnce, end) : std::min(begin + done, end),
          [&](std::size_t i)
          { leaves[i].Nodes = function.FindInside(leaves[i].Origin, LeafMask::All()); });
      }
    },
    [&](std::size_t n, auto& pass) { pass(&leaves[n].Nodes, 1); });
  return goesOn;
}

/** The nodes of a leaf that the box does not close. */
LeafMask FindNodesWithin(const LatticeBox& box, const openvdb::Coord& origin)
{
  LeafMask within;
  for (int node = 0; node < 512; ++node)
  {
    if (!box.Closes(origin.offsetBy(node >> 6, (node >> 3) & 7, node & 7)))
    {
      within.Add(node);
    }
  }
  return within;
}

/** Leaves that were not sampled are inside if an inside node is across one of their faces: no
 * surface is in them. */
void FillInside(const LatticeBox& box, std::size_t maximum, LeafSigns& leaves)
{
  for (std::size_t i = 0; i < leaves.Size(); ++i)
  {
    for (int face = 0; face < 6; ++face)
    {
      const int axis = face / 2, sign = face % 2 ? 1 : -1;
      if (TouchesFace(leaves[i].Nodes, axis, sign) &&
        leaves.FindNext(i, axis, sign) == LeafSigns::None)
      {
        const openvdb::Coord origin = leaves.OriginOfNext(i, axis, sign);
        leaves[leaves.Add(origin)].Nodes = FindNodesWithin(box, origin);
      }
    }
    RefuseManyLeaves(static_cast<double>(leaves.Size()), maximum);
  }
}

}

openvdb::FloatTree::Ptr MakeSparsePotential(double voxelSize, const double bounds[6],
  const InitialFunction& function, std::size_t maximumNumberOfActiveVoxels,
  const ProgressFunction& progress, Agreement* ranks)
{
  const LatticeBox box = FindLatticeBox(voxelSize, bounds);
  const LatticeFunction values(voxelSize, function, &box);
  LeafSigns inside;
  const std::shared_ptr<SharedStart> shared =
    AddLeaves(function, voxelSize, box, maximumNumberOfActiveVoxels, ranks, inside);
  if (!SampleInside(values, progress, ranks, inside))
  {
    return nullptr;
  }
  FillInside(box, maximumNumberOfActiveVoxels, inside);
  PartBand band(inside);
  if (band.CountActive() > maximumNumberOfActiveVoxels)
  {
    RefuseSize(maximumNumberOfActiveVoxels);
  }
  band.FindDistances(values, shared ? &shared->Owners : nullptr);
  return band.GetTree();
}

}
