#include "March/PartCores.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <vector>

namespace activesurface
{

namespace
{

constexpr double MostNodesPerAxis = 64.0;
constexpr double SmallestCore = .75, LargestCore = 2.5; // radius [voxels]
constexpr double SmallestHollow = 1.25; // a hollow needs nodes a voxel from its centre (NewParts.h)
// Least depth of a region common to surface and target from which a part can grow. The lattice
// needs a thickness of two voxels.
constexpr double LeastCommonDepth = 1.0; // [voxels]
constexpr std::size_t MostCommonNodes = 100000;
constexpr std::size_t CommonNodesAtOnce = 512;

using Places = std::vector<openvdb::Coord>;

/** Adds a node's neighbours to `known` and `waiting`, except differing nodes and known nodes. */
void AddBeside(const openvdb::Coord& place, DifferingNodes& nodes, std::set<openvdb::Coord>& known,
  Places& waiting)
{
  for (int face = 0; face < 6; ++face)
  {
    openvdb::Coord beside = place;
    beside[face / 2] += face % 2 ? 1 : -1;
    if (!nodes.Has(beside) && known.insert(beside).second)
    {
      waiting.push_back(beside);
    }
  }
}

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
    this->AddBarelyReached();
    this->Search.Target.ForEachPart([this](const TargetPart& part) { this->TryPart(part); });
    for (const openvdb::Coord& place : this->Nodes.FindDiffering(this->MakeLattice()))
    {
      this->Nodes.AddFrom(place);
      this->AddDeepest();
    }
    return this->Cores;
  }

private:
  /** Adds cores to parts that meet the surface only in a region too thin to grow from.
   * Without a core, this region would vanish together with adjacent regions outside the target, and
   * the part would never grow. */
  void AddBarelyReached()
  {
    std::vector<char> isKnown(this->Known);
    for (std::size_t i = 0; i < this->Known; ++i)
    {
      if (!isKnown[i])
      {
        const std::vector<std::size_t> part = this->Connected(i, isKnown);
        const std::size_t deepest = this->FindDeepest(part);
        if (this->Layer[deepest] > 0 && !this->HasCommonDepth(part))
        {
          this->AddCore(deepest);
        }
      }
    }
  }

  /** Returns the differing nodes on one side of the surface that are connected with node `first`,
   * which is on that side. */
  std::vector<std::size_t> Connected(std::size_t first, std::vector<char>& isKnown)
  {
    std::vector<std::size_t> part = { first };
    isKnown[first] = 1;
    for (std::size_t k = 0; k < part.size(); ++k)
    {
      for (int face = 0; face < 6; ++face)
      {
        const std::int32_t next = this->Nodes.FindNext(part[k], face / 2, face % 2 ? 1 : -1);
        if (next != DifferingNodes::None && !isKnown[next])
        {
          isKnown[next] = 1;
          part.push_back(static_cast<std::size_t>(next));
        }
      }
    }
    return part;
  }

  /** Returns a node in the innermost layer of a part. Layers are counted, because far from a mesh
   * all values of the target are equal. */
  std::size_t FindDeepest(const std::vector<std::size_t>& part)
  {
    this->Layer.resize(this->Nodes.Size(), -1);
    std::vector<std::size_t> reached;
    for (const std::size_t i : part)
    {
      for (int face = 0; face < 6 && this->Layer[i] < 0; ++face)
      {
        if (this->Nodes.FindNext(i, face / 2, face % 2 ? 1 : -1) == DifferingNodes::None)
        {
          this->Layer[i] = 0;
          reached.push_back(i);
        }
      }
    }
    for (std::size_t k = 0; k < reached.size(); ++k)
    {
      for (int face = 0; face < 6; ++face)
      {
        const std::int32_t next = this->Nodes.FindNext(reached[k], face / 2, face % 2 ? 1 : -1);
        if (next != DifferingNodes::None && this->Layer[next] < 0)
        {
          this->Layer[next] = this->Layer[reached[k]] + 1;
          reached.push_back(static_cast<std::size_t>(next));
        }
      }
    }
    return reached.back();
  }

  /** Returns true if a region common to surface and target, next to the part, is deep enough, or
   * too large to be searched. */
  bool HasCommonDepth(const std::vector<std::size_t>& part)
  {
    const bool areInside = !this->Nodes[part.front()].IsInside;
    std::set<openvdb::Coord> known;
    Places waiting;
    for (const std::size_t i : part)
    {
      AddBeside(this->Nodes[i].Place, this->Nodes, known, waiting);
    }
    while (!waiting.empty() && known.size() < MostCommonNodes + part.size() * 6)
    {
      const std::size_t count = std::min(waiting.size(), CommonNodesAtOnce);
      const Places places(waiting.end() - static_cast<std::ptrdiff_t>(count), waiting.end());
      waiting.resize(waiting.size() - count);
      const std::vector<double> depths = this->Nodes.FindCommonDepths(places, areInside);
      if (*std::max_element(depths.begin(), depths.end()) >= LeastCommonDepth)
      {
        return true;
      }
      for (std::size_t i = 0; i < count; ++i)
      {
        if (depths[i] >= 0.0)
        {
          AddBeside(places[i], this->Nodes, known, waiting);
        }
      }
    }
    return !waiting.empty();
  }

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

  /** Adds a core at the deepest of the nodes that were added last. */
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
    this->AddCore(deepest);
  }

  void AddCore(std::size_t deepest)
  {
    const DifferingNodes::Node& node = this->Nodes[deepest];
    const double voxel = this->Search.VoxelSize, spacing = this->Nodes.GetSpacing();
    const double smallest = node.IsInside ? SmallestHollow : SmallestCore;
    this->Cores.push_back(
      { { node.Place[0] * spacing, node.Place[1] * spacing, node.Place[2] * spacing },
        std::min(std::max(node.Distance, smallest * voxel), LargestCore * voxel), node.IsInside });
  }

  const ArrivalSearch& Search;
  DifferingNodes& Nodes;
  std::size_t Known = this->Nodes.Size(); //< nodes found from the surface, or with a core
  std::vector<int> Layer;                 //< of a node, from the border of its part; -1: unknown
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
}

}
