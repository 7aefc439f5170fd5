#include "Arrival/PartCores.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace activesurface
{

namespace
{

constexpr double MostNodesPerAxis = 64.0;
constexpr double SmallestCore = .75, LargestCore = 2.5; // radius [voxels]

class CoreSearch
{
public:
  CoreSearch(const ArrivalSearch& search, DifferingNodes& nodes)
    : Search(search)
    , Nodes(nodes)
  {
  }

  std::vector<PartCore> Find()
  {
    this->Search.Goal.ForEachPart([this](const TargetPart& part) { this->TryPart(part); });
    for (const openvdb::Coord& place : this->Nodes.FindDiffering(this->MakeLattice()))
    {
      this->Nodes.AddFrom(place);
      this->AddDeepest();
    }
    return this->Cores;
  }

private:
  void TryPart(const TargetPart& part)
  {
    part.ForEachSample(
      [this](const double x[3])
      {
        const bool isNew = this->Nodes.AddFrom(this->Nodes.FindNearest(x));
        this->AddDeepest();
        return !isNew;
      });
  }

  std::vector<openvdb::Coord> MakeLattice() const
  {
    const openvdb::Coord low = this->Corner(0), high = this->Corner(1);
    const openvdb::Coord size = high - low;
    const int longest = std::max({ size[0], size[1], size[2] });
    const int step = std::max(1, static_cast<int>(std::ceil(longest / MostNodesPerAxis)));
    std::vector<openvdb::Coord> places;
    for (int x = low[0]; x <= high[0]; x += step)
    {
      for (int y = low[1]; y <= high[1]; y += step)
      {
        for (int z = low[2]; z <= high[2]; z += step)
        {
          places.emplace_back(x, y, z);
        }
      }
    }
    return places;
  }

  openvdb::Coord Corner(int side) const
  {
    const auto& b = this->Search.Bounds;
    const double corner[3] = { b[side], b[2 + side], b[4 + side] };
    return this->Nodes.FindNearest(corner);
  }

  /** Of the nodes that were added last, unless there are none. */
  void AddDeepest()
  {
    if (this->Known == this->Nodes.Size())
    {
      return;
    }
    std::size_t deepest = this->Known;
    for (std::size_t i = this->Known; i < this->Nodes.Size(); ++i)
    {
      deepest = this->Nodes[i].Distance > this->Nodes[deepest].Distance ? i : deepest;
    }
    this->Known = this->Nodes.Size();
    const DifferingNodes::Node& node = this->Nodes[deepest];
    const double voxel = this->Search.VoxelSize, spacing = this->Nodes.GetSpacing();
    this->Cores.push_back(
      { { node.Place[0] * spacing, node.Place[1] * spacing, node.Place[2] * spacing },
        std::min(std::max(node.Distance, SmallestCore * voxel), LargestCore * voxel),
        node.IsInside });
  }

  const ArrivalSearch& Search;
  DifferingNodes& Nodes;
  std::size_t Known = this->Nodes.Size(); //< of the nodes, those that have had their core
  std::vector<PartCore> Cores;
};

}

std::vector<PartCore> FindPartCores(const ArrivalSearch& search)
{
  for (int stride = 1; stride <= LargestStride; stride *= 2)
  {
    DifferingNodes nodes(search, stride, MostDifferingNodes);
    std::vector<PartCore> cores = CoreSearch(search, nodes).Find();
    if (!nodes.IsCut())
    {
      return cores;
    }
  }
  return {};
}

void CoreTarget::VisitRegions(std::size_t first, std::size_t end, const RegionVisitor& visit) const
{
  for (std::size_t i = first; i < end; ++i)
  {
    const PartCore& core = this->Cores[i];
    TargetRegion region;
    for (int axis = 0; axis < 3; ++axis)
    {
      region.Bounds[2 * axis] = core.Centre[axis] - core.Radius;
      region.Bounds[2 * axis + 1] = core.Centre[axis] + core.Radius;
    }
    region.Seeds = RegionSeeds::Centre;
    visit(region);
  }
}

void CoreTarget::Evaluate(
  std::size_t count, const double* points, const TargetResults& results) const
{
  for (std::size_t i = 0; i < count; ++i)
  {
    double nearest = std::numeric_limits<double>::infinity();
    for (const PartCore& core : this->Cores)
    {
      const double x = points[3 * i] - core.Centre[0], y = points[3 * i + 1] - core.Centre[1],
                   z = points[3 * i + 2] - core.Centre[2];
      const double distance = std::sqrt(x * x + y * y + z * z) - core.Radius;
      if (distance < nearest)
      {
        nearest = distance;
        results.Values[i] = core.IsHollow ? -distance : distance;
      }
    }
    results.Slopes[i] = 1.0;
  }
  SetStill(count, results);
}

}
