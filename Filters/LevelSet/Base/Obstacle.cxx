#include "Base/Obstacle.h"

#include "Base/OpenVDB.h"
#include "Base/StaticShutdown.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iomanip>
#include <iterator>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace activesurface
{

namespace
{

constexpr int NodesOfLeaf = 512;
constexpr float Nowhere = -1e6f; // depth where the obstacle has no effect

openvdb::Coord ToCoord(const std::array<int, 3>& node)
{
  return openvdb::Coord(node.data());
}

/** The nodes around a coordinate [voxels] along one axis. A coordinate within 1e-6 voxel of a node
 * counts as on the node. */
struct Neighbours
{
  int Lower;
  double Fraction; //< position between Lower (0) and the next node (1)

  explicit Neighbours(double place)
  {
    constexpr double rounding = 1e-6;
    const double nearest = std::nearbyint(place);
    const bool isNode = std::fabs(place - nearest) < rounding;
    this->Lower = static_cast<int>(isNode ? nearest : std::floor(place));
    this->Fraction = isNode ? 0.0 : place - this->Lower;
  }
};

}

/** Depths at active nodes are known. In active tiles the obstacle has no effect. */
struct Obstacle::SampledDepths
{
  openvdb::FloatTree::Ptr Tree = std::make_shared<openvdb::FloatTree>(Nowhere);

  ~SampledDepths() { ReleaseUnlessExiting(std::move(this->Tree)); }
};

Obstacle::Obstacle(double voxelSize, const DistanceFunction& distances, bool isThreadSafe,
  const std::array<double, 3>& origin)
  : VoxelSize(voxelSize)
  , Distances(distances)
  , ThreadSafe(isThreadSafe)
  , Origin(origin)
  , Depths(std::make_unique<SampledDepths>())
{
}

Obstacle::~Obstacle() = default;

float Obstacle::ToDepth(double distance) const
{
  const double depth = -distance / this->VoxelSize;
  return depth > -Reach ? static_cast<float>(std::min(depth, double(Reach))) : Nowhere;
}

/** Returns false if the function is NaN at a node. */
bool Obstacle::SampleLeaf(const LeafOrigin& origin, float* depths) const
{
  double points[3 * NodesOfLeaf], distances[NodesOfLeaf];
  for (int node = 0; node < NodesOfLeaf; ++node)
  {
    const int place[3] = { origin[0] + (node >> 6), origin[1] + ((node >> 3) & 7),
      origin[2] + (node & 7) };
    for (int axis = 0; axis < 3; ++axis)
    {
      points[3 * node + axis] = this->VoxelSize * place[axis];
    }
  }
  this->Distances(NodesOfLeaf, points, distances);
  for (int node = 0; node < NodesOfLeaf; ++node)
  {
    depths[node] = this->ToDepth(distances[node]);
  }
  return std::none_of(
    distances, distances + NodesOfLeaf, [](double distance) { return std::isnan(distance); });
}

void Obstacle::SampleLeaves(const std::vector<LeafOrigin>& origins)
{
  std::vector<LeafOrigin> unknown;
  std::copy_if(origins.begin(), origins.end(), std::back_inserter(unknown),
    [this](const LeafOrigin& origin) { return !this->IsKnown(origin); });
  std::vector<std::array<float, NodesOfLeaf>> depths(unknown.size());
  std::vector<char> areNumbers(unknown.size());
  const auto sample = [&](const tbb::blocked_range<std::size_t>& range)
  {
    for (std::size_t i = range.begin(); i != range.end(); ++i)
    {
      areNumbers[i] = this->SampleLeaf(unknown[i], depths[i].data()) ? 1 : 0;
    }
  };
  const tbb::blocked_range<std::size_t> all(0, unknown.size());
  if (this->ThreadSafe)
  {
    tbb::parallel_for(all, sample);
  }
  else
  {
    sample(all);
  }
  for (std::size_t i = 0; i < unknown.size(); ++i)
  {
    if (!areNumbers[i] && !this->IsBad)
    {
      this->IsBad = true;
      this->BadLeaf = unknown[i];
    }
    if (std::any_of(
          depths[i].begin(), depths[i].end(), [](float depth) { return depth > Nowhere; }))
    {
      auto* leaf = this->Depths->Tree->touchLeaf(ToCoord(unknown[i]));
      std::copy(depths[i].begin(), depths[i].end(), leaf->buffer().data());
      leaf->setValuesOn();
    }
    else
    {
      this->Depths->Tree->addTile(1, ToCoord(unknown[i]), Nowhere, true);
    }
  }
}

bool Obstacle::IsKnown(const LeafOrigin& origin) const
{
  return this->Depths->Tree->isValueOn(ToCoord(origin));
}

const float* Obstacle::FindDepths(const LeafOrigin& origin) const
{
  const auto* leaf = this->Depths->Tree->probeConstLeaf(ToCoord(origin));
  return leaf ? leaf->buffer().data() : nullptr;
}

float Obstacle::DepthOfNode(const std::array<int, 3>& node) const
{
  float known;
  if (this->Depths->Tree->probeValue(ToCoord(node), known))
  {
    return known;
  }
  const double place[3] = { this->VoxelSize * node[0], this->VoxelSize * node[1],
    this->VoxelSize * node[2] };
  double distance;
  this->Distances(1, place, &distance);
  return this->ToDepth(distance);
}

double Obstacle::DepthAt(const double x[3]) const
{
  constexpr double farthest = 1e9; // coordinates are int
  const double place[3] = { x[0] / this->VoxelSize, x[1] / this->VoxelSize,
    x[2] / this->VoxelSize };
  if (!std::all_of(place, place + 3, [](double c) { return std::fabs(c) < farthest; }))
  {
    return -HUGE_VAL;
  }
  const std::array<Neighbours, 3> along = { Neighbours(place[0]), Neighbours(place[1]),
    Neighbours(place[2]) };
  double depth = 0.0;
  for (int corner = 0; corner < 8; ++corner)
  {
    std::array<int, 3> node;
    double weight = 1.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      const int upper = corner >> axis & 1;
      node[axis] = along[axis].Lower + upper;
      weight *= upper ? along[axis].Fraction : 1.0 - along[axis].Fraction;
    }
    const float own = weight > 0.0 ? this->DepthOfNode(node) : 0.f;
    if (own == Nowhere)
    {
      return -HUGE_VAL;
    }
    depth += weight * own;
  }
  return this->VoxelSize * depth;
}

void Obstacle::Check() const
{
  if (this->IsBad)
  {
    double first[3];
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      first[axis] = this->Origin[axis] + this->VoxelSize * this->BadLeaf[axis];
    }
    std::ostringstream text;
    text << std::setprecision(10) << "ObstacleFunction is not a number at a point within "
         << 7.0 * this->VoxelSize << " of (" << first[0] << ", " << first[1] << ", " << first[2]
         << ") along each axis; make ObstacleFunction return numbers near the skin.";
    throw std::runtime_error(text.str());
  }
}

}
