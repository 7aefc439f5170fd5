#include "Start/LeafSigns.h"

#include "Start/LatticeBox.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace activesurface
{

namespace
{

openvdb::Coord LeafCoordinates(const openvdb::Coord& origin)
{
  return origin >> 3;
}

/** Finds the smallest box of nodes that contains a region, within the limits. Returns false if the
 * box is empty, or the region is empty or not finite. */
bool FindNodes(const TargetRegion& region, double voxelSize, const LatticeBox* limits,
  openvdb::Coord& first, openvdb::Coord& last)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const double low = region.Bounds[2 * axis] / voxelSize;
    const double high = region.Bounds[2 * axis + 1] / voxelSize;
    if (!(low <= high) || !std::isfinite(low) || !std::isfinite(high))
    {
      return false;
    }
    const double least = limits ? limits->First[axis] : -FarthestNode;
    const double most = limits ? limits->Last[axis] : FarthestNode;
    if (std::ceil(high) < least || std::floor(low) > most)
    {
      return false;
    }
    first[axis] = static_cast<int>(std::max(std::floor(low), least));
    last[axis] = static_cast<int>(std::min(std::ceil(high), most));
  }
  return true;
}

}

std::int32_t LeafSigns::Find(const openvdb::Coord& origin) const
{
  return this->Recent.getValue(LeafCoordinates(origin));
}

bool LeafSigns::Has(const openvdb::Coord& node) const
{
  const std::int32_t leaf = this->Find(OriginOfLeaf(node));
  return leaf != None && this->Leaves[leaf].Nodes.Has(NumberInLeaf(node));
}

std::int32_t LeafSigns::Add(const openvdb::Coord& origin)
{
  const std::int32_t known = this->Find(origin);
  if (known != None)
  {
    return known;
  }
  const auto number = static_cast<std::int32_t>(this->Leaves.size());
  this->Leaves.push_back({ origin, LeafMask() });
  this->Recent.setValue(LeafCoordinates(origin), number);
  return number;
}

void LeafSigns::AddRegion(const TargetRegion& region, double voxelSize, const LatticeBox* limits,
  std::size_t maximumNumberOfActiveVoxels)
{
  openvdb::Coord first, last;
  if (!FindNodes(region, voxelSize, limits, first, last))
  {
    return;
  }
  const openvdb::Coord low = LeafCoordinates(first), high = LeafCoordinates(last);
  double leaves = 1.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    leaves *= double(high[axis]) - low[axis] + 1.0;
  }
  RefuseManyLeaves(leaves, maximumNumberOfActiveVoxels);
  for (int x = low[0]; x <= high[0]; ++x)
  {
    for (int y = low[1]; y <= high[1]; ++y)
    {
      for (int z = low[2]; z <= high[2]; ++z)
      {
        this->Add(openvdb::Coord(8 * x, 8 * y, 8 * z));
      }
    }
  }
  RefuseManyLeaves(static_cast<double>(this->Size()), maximumNumberOfActiveVoxels);
}

openvdb::Coord LeafSigns::OriginOfNext(std::size_t i, int axis, int sign) const
{
  openvdb::Coord origin = this->Leaves[i].Origin;
  origin[axis] += 8 * sign;
  return origin;
}

std::int32_t LeafSigns::FindNext(std::size_t i, int axis, int sign) const
{
  return this->Find(this->OriginOfNext(i, axis, sign));
}

void RefuseManyLeaves(double leaves, std::size_t maximumNumberOfActiveVoxels)
{
  constexpr double nodesPerActiveVoxel = 40.0; // as in a dense start
  if (512.0 * leaves > nodesPerActiveVoxel * static_cast<double>(maximumNumberOfActiveVoxels))
  {
    std::ostringstream text;
    text << "The region to search for the skin has " << 512.0 * leaves
         << " voxels or more, more than 40 times MaximumNumberOfActiveVoxels (now "
         << maximumNumberOfActiveVoxels << "); enlarge VoxelSize, check that target and initial "
         << "shape are bounded, or raise the maximum.";
    throw std::runtime_error(text.str());
  }
}

}
