#include "March/RemainingDistance.h"

#include "Leaves/EikonalUpdate.h"

#include "Base/OpenVDB.h"

#include <openvdb/tree/ValueAccessor.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>

namespace activesurface
{

namespace
{

/** Fast marching: lowers the value a(x) at each node x to the minimum over y of a(y) + d(x,y),
 * where d(x,y) is the distance between two nodes. */
class Marching
{
public:
  explicit Marching(DifferingNodes& nodes)
    : Spacing(nodes.GetSpacing())
    , Neighbours(nodes.Size())
  {
    for (std::size_t i = 0; i < nodes.Size(); ++i)
    {
      for (int face = 0; face < 6; ++face)
      {
        this->Neighbours[i][face] = nodes.FindNext(i, face / 2, face % 2 ? 1 : -1);
      }
    }
  }

  void Run(std::vector<double>& values) const
  {
    this->Run(values, [](std::int32_t, Front&) {});
  }

  /** Runs the march with exact distances around cores: paths from all directions end there, so the
   * eikonal update is inaccurate. Returns for each node x the y that gives K(x) in
   * RemainingDistance.h.
   */
  std::vector<std::int32_t> RunFromCores(std::vector<double>& values) const
  {
    return this->Run(values,
      [&](std::int32_t i, Front& front)
      {
        if (front.Origins[i] == i && this->IsCore(i))
        {
          this->GoAround(i, values, front);
        }
      });
  }

  /** Returns true if all six neighbours of y = node i differ on the same side. If y is also the end
   * of a path, y is not at the target, but in the middle of a vanishing part or hollow, where the
   * surface arrives from all sides. */
  bool IsCore(std::int32_t i) const
  {
    const std::array<std::int32_t, 6>& around = this->Neighbours[i];
    return std::count(around.begin(), around.end(), DifferingNodes::None) == 0;
  }

private:
  using Entry = std::pair<double, std::int32_t>; // ties: by index
  using Queue = std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>>;

  struct Front
  {
    Queue Next;
    std::vector<char> IsKnown;
    std::vector<std::int32_t> Origins;

    void Lower(std::vector<double>& values, std::int32_t node, double value, std::int32_t origin)
    {
      values[node] = value;
      this->Origins[node] = origin;
      this->Next.push({ value, node });
    }
  };

  /** begin: called for each node once its value is final. */
  template <class Begin>
  std::vector<std::int32_t> Run(std::vector<double>& values, Begin begin) const
  {
    Front front{ Queue(), std::vector<char>(values.size(), 0),
      std::vector<std::int32_t>(values.size()) };
    std::iota(front.Origins.begin(), front.Origins.end(), 0);
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      if (std::isfinite(values[i]))
      {
        front.Next.push({ values[i], static_cast<std::int32_t>(i) });
      }
    }
    std::vector<char>& isKnown = front.IsKnown;
    while (!front.Next.empty())
    {
      const std::int32_t i = front.Next.top().second;
      front.Next.pop();
      if (isKnown[i])
      {
        continue;
      }
      isKnown[i] = 1;
      begin(i, front);
      for (const std::int32_t next : this->Neighbours[i])
      {
        const double better = next == DifferingNodes::None || isKnown[next]
          ? std::numeric_limits<double>::infinity()
          : this->Solve(next, values, isKnown);
        if (std::isfinite(better) && better < values[next])
        {
          front.Lower(values, next, better, front.Origins[i]);
        }
      }
    }
    return std::move(front.Origins);
  }

  /** Measures straight paths from a node to the nodes within four spacings. */
  void GoAround(std::int32_t from, std::vector<double>& values, Front& front) const
  {
    constexpr int reach = 4, width = 2 * reach + 1;
    std::array<char, width * width * width> isSeen{};
    std::vector<std::pair<std::int32_t, openvdb::Coord>> seen = { { from, openvdb::Coord() } };
    const auto isSeenAt = [&](const openvdb::Coord& way) -> char& {
      return isSeen[(way[0] + reach) * width * width + (way[1] + reach) * width + way[2] + reach];
    };
    isSeenAt({}) = 1;
    for (std::size_t n = 0; n < seen.size(); ++n)
    {
      for (int face = 0; face < 6; ++face)
      {
        openvdb::Coord way = seen[n].second;
        way[face / 2] += face % 2 ? 1 : -1;
        const std::int32_t next = this->Neighbours[seen[n].first][face];
        const int square = way[0] * way[0] + way[1] * way[1] + way[2] * way[2];
        if (next == DifferingNodes::None || square > reach * reach || isSeenAt(way))
        {
          continue;
        }
        isSeenAt(way) = 1;
        seen.push_back({ next, way });
        const double value = values[from] + this->Spacing * std::sqrt(square);
        if (!front.IsKnown[next] && value < values[next])
        {
          front.Lower(values, next, value, from);
        }
      }
    }
  }

  double Solve(
    std::int32_t i, const std::vector<double>& values, const std::vector<char>& isKnown) const
  {
    const auto isOf = [&](std::int32_t node)
    { return node != DifferingNodes::None && isKnown[node]; };
    std::array<UpwindTerm, 3> terms;
    int count = 0;
    for (int axis = 0; axis < 3; ++axis)
    {
      double nearest = std::numeric_limits<double>::infinity();
      for (int face = 2 * axis; face < 2 * axis + 2; ++face)
      {
        const std::int32_t next = this->Neighbours[i][face];
        if (!isOf(next) || !(values[next] < nearest))
        {
          continue;
        }
        nearest = values[next];
        const std::int32_t beyond = this->Neighbours[next][face];
        const double a1 = nearest / this->Spacing;
        terms[count] =
          isOf(beyond) ? SecondOrderTerm(a1, values[beyond] / this->Spacing) : FirstOrderTerm(a1);
      }
      count += std::isfinite(nearest) ? 1 : 0;
    }
    return this->Spacing * SolveEikonal(terms, count);
  }

  const double Spacing;
  std::vector<std::array<std::int32_t, 6>> Neighbours;
};

/** Distances [length] from the surface at nodes that have a neighbour on the other side of the
 * surface; infinite at other nodes. */
std::vector<double> FindDistancesBesideSurface(const DifferingNodes& nodes, double voxelSize)
{
  std::vector<double> distances(nodes.Size(), std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < nodes.Size(); ++i)
  {
    for (int face = 0; face < 6; ++face)
    {
      openvdb::Coord beside = nodes[i].Place;
      beside[face / 2] += face % 2 ? 1 : -1;
      if (nodes.IsInside(beside) != nodes[i].IsInside)
      {
        distances[i] = voxelSize * std::fabs(nodes.PotentialAt(nodes[i].Place));
      }
    }
  }
  return distances;
}

/** gain: T(y) - T(x); detour: d(x,y) - gain; see RemainingDistance.h. Returns `detour` if detour <=
 * 0.1 gain: x is then on a bump of the surface. Returns 0 if detour >= 0.3 gain: x is then beside
 * the path. The transition between the two limits is smooth. */
double FindDetour(double gain, double detour)
{
  constexpr double most = .1, none = .3; // of the gain
  if (!(gain > 0.0 && detour > 0.0))
  {
    return 0.0;
  }
  const double t = std::min(std::max((none - detour / gain) / (none - most), 0.0), 1.0);
  return t * t * (3.0 - 2.0 * t) * detour;
}

double InterpolateKnown(
  const openvdb::tree::ValueAccessor<const openvdb::FloatTree>& values, const double point[3])
{
  openvdb::Coord low;
  double fraction[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    low[axis] = static_cast<int>(std::floor(point[axis]));
    fraction[axis] = point[axis] - low[axis];
  }
  double sum = 0.0, weights = 0.0;
  for (int corner = 0; corner < 8; ++corner)
  {
    const int x = corner & 1, y = (corner >> 1) & 1, z = corner >> 2;
    const double value = values.getValue(low.offsetBy(x, y, z));
    const double weight = (x ? fraction[0] : 1.0 - fraction[0]) *
      (y ? fraction[1] : 1.0 - fraction[1]) * (z ? fraction[2] : 1.0 - fraction[2]);
    sum += value >= 0.0 ? weight * value : 0.0;
    weights += value >= 0.0 ? weight : 0.0;
  }
  return weights > 0.0 ? sum / weights : -1.0;
}

}

RemainingDistance::RemainingDistance(const ArrivalSearch& search)
{
  for (int stride = 1; stride <= LargestStride; stride *= 2)
  {
    DifferingNodes nodes(search, stride, MostDifferingNodes);
    if (!nodes.IsCut())
    {
      this->Keep(nodes);
      return;
    }
  }
}

void RemainingDistance::Keep(DifferingNodes& nodes)
{
  this->Spacing = nodes.GetSpacing();
  const Marching marching(nodes);
  std::vector<double> reached =
    FindDistancesBesideSurface(nodes, this->Spacing / nodes.GetStride());
  marching.Run(reached);
  std::vector<double> farthest(reached.size());
  for (std::size_t i = 0; i < reached.size(); ++i)
  {
    const bool isReached = std::isfinite(reached[i]);
    farthest[i] = isReached ? -2.0 * reached[i] : std::numeric_limits<double>::infinity();
  }
  const std::vector<std::int32_t> goals = marching.RunFromCores(farthest);
  for (std::size_t i = 0; i < reached.size(); ++i)
  {
    if (std::isfinite(reached[i]))
    {
      openvdb::FloatTree& side = nodes[i].IsInside ? this->Shrinking : this->Growing;
      const double gain = reached[goals[i]] - reached[i];
      const double kept = -farthest[i] - 2.0 * reached[i];
      const double detour = marching.IsCore(goals[i]) ? FindDetour(gain, gain - kept) : 0.0;
      const double distance = kept + 2.0 * detour;
      side.setValue(nodes[i].Place, static_cast<float>(distance));
      this->ExtendBehindSurface(nodes, i, distance);
    }
  }
}

/** Continues the distance to the neighbours across the surface. The path from a neighbour is
 * longer. Interpolated values at the surface are then between the distances at the node and at the
 * neighbour. */
void RemainingDistance::ExtendBehindSurface(
  const DifferingNodes& nodes, std::size_t i, double distance)
{
  openvdb::FloatTree& side = nodes[i].IsInside ? this->Shrinking : this->Growing;
  const double here = nodes.PotentialAt(nodes[i].Place);
  for (int face = 0; face < 6; ++face)
  {
    openvdb::Coord beside = nodes[i].Place;
    beside[face / 2] += face % 2 ? 1 : -1;
    if (nodes.IsInside(beside) != nodes[i].IsInside)
    {
      const double voxel = this->Spacing / nodes.GetStride();
      const double longer = distance + voxel * std::fabs(here - nodes.PotentialAt(beside));
      side.setValue(beside, std::max(side.getValue(beside), static_cast<float>(longer)));
    }
  }
}

void RemainingDistance::Find(
  std::size_t count, const double* points, const bool* grow, double* distances) const
{
  const openvdb::tree::ValueAccessor<const openvdb::FloatTree> growing(this->Growing);
  const openvdb::tree::ValueAccessor<const openvdb::FloatTree> shrinking(this->Shrinking);
  for (std::size_t i = 0; i < count; ++i)
  {
    const double point[3] = { points[3 * i] / this->Spacing, points[3 * i + 1] / this->Spacing,
      points[3 * i + 2] / this->Spacing };
    distances[i] = InterpolateKnown(grow[i] ? growing : shrinking, point);
  }
}

}
