#include "Start/NearbyStart.h"

#include "Base/OpenVDB.h"
#include "Leaves/LeafFaces.h"
#include "Leaves/LeafTable.h"
#include "Start/InitialDistances.h"
#include "Start/InitialShape.h"
#include "Start/LatticeBox.h"
#include "Start/LatticeFunction.h"
#include "Start/LeafSigns.h"
#include "Start/PartBand.h"

#include <openvdb/tools/Morphology.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace activesurface
{

namespace
{

/** Number of layers of nodes to sample around the node nearest to a surface point. The layers
 * contain the ends of each edge crossed within Reach of the point, and all corners of the voxels at
 * this edge. */
int FindRings(const SurfacePoints& surface, double voxelSize)
{
  return static_cast<int>(std::ceil(surface.Reach / voxelSize + 2.5)) - 1;
}

/** Adds the nodes near the surface points. Rejects too many nodes before creating all of them: each
 * node that is nearest to a point counts as a surface area of Reach * Reach. */
void AddNearby(const SurfacePoints& surface, double voxelSize, const LatticeBox& box,
  std::size_t maximumNumberOfActiveVoxels, openvdb::MaskTree& wanted)
{
  const int rings = FindRings(surface, voxelSize);
  openvdb::tree::ValueAccessor<openvdb::MaskTree> accessor(wanted);
  surface.ForEach(
    [&](const double x[3])
    {
      openvdb::Coord node;
      for (int axis = 0; axis < 3; ++axis)
      {
        const double place = std::floor(x[axis] / voxelSize + .5);
        if (!(place >= double(box.First[axis]) - rings && place <= double(box.Last[axis]) + rings))
        {
          return;
        }
        node[axis] = static_cast<int>(place);
      }
      accessor.setValueOn(node);
    });
  const double reach = surface.Reach / voxelSize;
  if (static_cast<double>(wanted.activeVoxelCount()) * reach * reach >
    static_cast<double>(maximumNumberOfActiveVoxels))
  {
    RefuseSize(maximumNumberOfActiveVoxels);
  }
  openvdb::tools::dilateActiveValues(
    wanted, rings, openvdb::tools::NN_FACE_EDGE_VERTEX, openvdb::tools::IGNORE_TILES);
}

/** Finds the box of the nodes that may be inside. Returns false if the box is empty. */
bool FindInsideBox(
  const SurfacePoints& surface, double voxelSize, const LatticeBox& box, openvdb::CoordBBox& within)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const double low = std::floor(surface.Bounds[2 * axis] / voxelSize) - 1.0;
    const double high = std::ceil(surface.Bounds[2 * axis + 1] / voxelSize) + 1.0;
    const double first = box.First[axis], last = box.Last[axis];
    if (!(low <= last && high >= first))
    {
      return false;
    }
    within.min()[axis] = static_cast<int>(std::max(low, first));
    within.max()[axis] = static_cast<int>(std::min(high, last));
  }
  return true;
}

/** Adds the nodes near the faces of the box, where faces or walls may cut the inside. */
void AddFaces(const SurfacePoints& surface, double voxelSize, const LatticeBox& box,
  std::size_t maximum, openvdb::MaskTree& wanted)
{
  openvdb::CoordBBox within;
  if (!FindInsideBox(surface, voxelSize, box, within))
  {
    return;
  }
  // Nodes on both sides of the cut, and one more layer.
  const int layers = static_cast<int>(std::ceil(surface.DepthOfWalls / voxelSize)) + 2;
  for (int face = 0; face < 6; ++face)
  {
    const int axis = face / 2;
    openvdb::CoordBBox layer = within;
    if (face % 2 == 0)
    {
      layer.max()[axis] = std::min(layer.max()[axis], box.First[axis] + layers);
    }
    else
    {
      layer.min()[axis] = std::max(layer.min()[axis], box.Last[axis] - layers);
    }
    if (layer.min()[axis] <= layer.max()[axis])
    {
      RefuseManyLeaves(static_cast<double>(layer.volume()) / 512.0, maximum);
      wanted.denseFill(layer, true, true);
    }
  }
}

/** Nodes to be sampled, and masks of the inside nodes. */
struct Samples
{
  LeafSigns Nodes;
  std::vector<LeafMask> Inside;

  const LeafMask& NodesOf(std::int32_t leaf) const { return this->Nodes[leaf].Nodes; }
};

LeafMask MaskOf(const openvdb::MaskTree::LeafNodeType& leaf, const LatticeBox& box)
{
  LeafMask mask;
  for (auto it = leaf.cbeginValueOn(); it; ++it)
  {
    const openvdb::Coord node = it.getCoord();
    bool isWithin = true;
    for (int axis = 0; axis < 3; ++axis)
    {
      isWithin = isWithin && node[axis] >= box.First[axis] && node[axis] <= box.Last[axis];
    }
    if (isWithin)
    {
      mask.Add(static_cast<int>(it.pos()));
    }
  }
  return mask;
}

/** Returns false if `progress` cancelled the sampling. */
bool Sample(const LatticeFunction& function, const ProgressFunction& progress, Samples& samples)
{
  constexpr std::size_t atOnce = 1024;
  const std::size_t count = samples.Nodes.Size();
  samples.Inside.resize(count);
  for (std::size_t first = 0; first < count; first += atOnce)
  {
    if (progress && !progress(double(first) / double(count)))
    {
      return false;
    }
    function.ForEach(first, std::min(first + atOnce, count),
      [&](std::size_t i)
      {
        const auto& leaf = samples.Nodes[i];
        samples.Inside[i] = function.FindInside(leaf.Origin, leaf.Nodes);
      });
  }
  return true;
}

/** Combines the masks of leaves with those of their neighbours. */
class Neighbours
{
public:
  explicit Neighbours(const LeafSigns& leaves)
    : Leaves(leaves)
  {
  }

  /** Combines each node's bit with the bits of the seven nodes ahead of the node (sign > 0), or
   * behind the node: these are the corners of a voxel. */
  template <class Combine>
  void CombineCorners(std::vector<LeafMask>& masks, int sign, Combine&& combine) const
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      std::vector<LeafMask> next(masks.size());
      for (std::size_t i = 0; i < masks.size(); ++i)
      {
        const std::int32_t across = this->Leaves.FindNext(i, axis, sign);
        const LeafMask there = across == LeafSigns::None ? LeafMask() : masks[across];
        const LeafMask seen =
          sign > 0 ? SeenAhead(masks[i], there, axis, 1) : SeenBehind(masks[i], there, axis, 1);
        next[i] = combine(masks[i], seen);
      }
      masks.swap(next);
    }
  }

private:
  const LeafSigns& Leaves;
};

/** Returns the corners of crossed voxels: voxels with eight sampled corners of different signs. */
std::vector<LeafMask> FindCorners(const Samples& samples)
{
  const auto all = [](const LeafMask& a, const LeafMask& b) { return a & b; };
  const auto any = [](const LeafMask& a, const LeafMask& b) { return a | b; };
  const Neighbours neighbours(samples.Nodes);
  std::vector<LeafMask> known(samples.Inside.size());
  for (std::size_t i = 0; i < known.size(); ++i)
  {
    known[i] = samples.Nodes[i].Nodes;
  }
  std::vector<LeafMask> inside = samples.Inside, touched = samples.Inside;
  neighbours.CombineCorners(known, 1, all);
  neighbours.CombineCorners(inside, 1, all);
  neighbours.CombineCorners(touched, 1, any);
  for (std::size_t i = 0; i < known.size(); ++i)
  {
    touched[i] = (touched[i] & known[i]).Without(inside[i]);
  }
  neighbours.CombineCorners(touched, -1, any);
  return touched;
}

void AddCrossed(const Samples& samples, CrossedNodes& crossed)
{
  const std::vector<LeafMask> corners = FindCorners(samples);
  openvdb::tree::ValueAccessor<openvdb::BoolTree> accessor(crossed.Nodes);
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    const openvdb::Coord& origin = samples.Nodes[i].Origin;
    corners[i].ForEach([&](int node)
      { accessor.setValueOn(origin.offsetBy(node >> 6, (node >> 3) & 7, node & 7)); });
  }
}

/** Returns the function at nodes, with NaN replaced by an outside value. */
NodeFunction ValuesAtNodes(const LatticeFunction& function, bool isThreadSafe)
{
  return { [&function](const std::vector<openvdb::Coord>& nodes, std::vector<double>& values)
    {
      function.Evaluate(nodes, values);
      std::replace_if(
        values.begin(), values.end(), [](double value) { return std::isnan(value); }, HUGE_VAL);
    },
    isThreadSafe };
}

double FindLargest(const openvdb::BoolTree& nodes, const NodeFunction& function)
{
  std::vector<openvdb::Coord> places;
  for (auto it = nodes.cbeginValueOn(); it; ++it)
  {
    places.push_back(it.getCoord());
  }
  std::vector<double> values;
  function.Evaluate(places, values);
  double largest = 0.0;
  for (const double value : values)
  {
    largest = std::isfinite(value) ? std::max(largest, std::fabs(value)) : largest;
  }
  return largest;
}

}

openvdb::FloatTree::Ptr MakeNearbyPotential(double voxelSize, const double bounds[6],
  const InitialFunction& function, std::size_t maximumNumberOfActiveVoxels,
  const ProgressFunction& progress)
{
  const LatticeBox box = FindLatticeBox(voxelSize, bounds);
  const LatticeFunction values(voxelSize, function, &box);
  Samples samples;
  {
    openvdb::MaskTree wanted;
    AddNearby(function.Surface, voxelSize, box, maximumNumberOfActiveVoxels, wanted);
    AddFaces(function.Surface, voxelSize, box, maximumNumberOfActiveVoxels, wanted);
    RefuseManyLeaves(static_cast<double>(wanted.leafCount()), maximumNumberOfActiveVoxels);
    for (auto leaf = wanted.cbeginLeaf(); leaf; ++leaf)
    {
      samples.Nodes[samples.Nodes.Add(leaf->origin())].Nodes = MaskOf(*leaf, box);
    }
  }
  if (!Sample(values, progress, samples))
  {
    return nullptr;
  }
  CrossedNodes crossed;
  AddCrossed(samples, crossed);
  if (crossed.Nodes.activeVoxelCount() > maximumNumberOfActiveVoxels)
  {
    RefuseSize(maximumNumberOfActiveVoxels);
  }
  const NodeFunction nodes = ValuesAtNodes(values, function.ThreadSafe);
  crossed.Largest = FindLargest(crossed.Nodes, nodes);
  const openvdb::FloatTree::Ptr potential =
    crossed.Nodes.empty() ? nullptr : MakeNearbyDistances(crossed, nodes);
  return potential ? potential : std::make_shared<openvdb::FloatTree>(Far);
}

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

/** Returns the nodes of a leaf that lie within the outermost nodes of the box. */
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

/** Fills each unsampled leaf that has an inside node across one of its faces, leaf after leaf. The
 * surface does not cross an unsampled leaf, so the nodes of such a leaf within the box are inside.
 */
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
