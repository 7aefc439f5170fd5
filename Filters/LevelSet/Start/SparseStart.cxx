#include "Start/SparseStart.h"

#include "Leaves/LeafFaces.h"
#include "Start/InitialShape.h"
#include "Start/LatticeBox.h"
#include "Start/LatticeFunction.h"
#include "Start/LeafSigns.h"
#include "Start/PartBand.h"

#include <algorithm>

namespace activesurface
{

namespace
{

/** Returns false if `progress` cancelled the sampling. */
bool SampleInside(
  const LatticeFunction& function, const ProgressFunction& progress, LeafSigns& leaves)
{
  constexpr std::size_t atOnce = 1024;
  for (std::size_t begin = 0; begin < leaves.Size(); begin += atOnce)
  {
    if (progress && !progress(double(begin) / double(leaves.Size())))
    {
      return false;
    }
    function.ForEach(begin, std::min(begin + atOnce, leaves.Size()),
      [&](std::size_t i)
      { leaves[i].Nodes = function.FindInside(leaves[i].Origin, LeafMask::All()); });
  }
  return true;
}

/** Returns the nodes of a leaf that the box does not set to outside. */
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

/** Fills unsampled leaves that have an inside node across one of their faces. No surface is in
 * such a leaf, so it is inside. */
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
  const ProgressFunction& progress)
{
  const LatticeBox box = FindLatticeBox(voxelSize, bounds);
  const LatticeFunction values(voxelSize, function, &box);
  LeafSigns inside;
  function.ForEachRegion([&](const TargetRegion& region)
    { inside.AddRegion(region, voxelSize, &box, maximumNumberOfActiveVoxels); });
  if (!SampleInside(values, progress, inside))
  {
    return nullptr;
  }
  FillInside(box, maximumNumberOfActiveVoxels, inside);
  PartBand band(inside);
  if (band.CountActive() > maximumNumberOfActiveVoxels)
  {
    RefuseSize(maximumNumberOfActiveVoxels);
  }
  band.FindDistances(values);
  return band.GetTree();
}

}
