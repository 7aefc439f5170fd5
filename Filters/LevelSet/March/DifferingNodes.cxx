#include "March/DifferingNodes.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace activesurface
{

namespace
{

constexpr std::int32_t Unknown = -2;

openvdb::CoordBBox FindLimits(const std::array<double, 6>& bounds, double spacing)
{
  constexpr double farthest = 1e8;
  openvdb::CoordBBox limits;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double low = std::floor(bounds[2 * axis] / spacing);
    const double high = std::ceil(bounds[2 * axis + 1] / spacing);
    limits.min()[axis] = static_cast<int>(std::max(low, -farthest));
    limits.max()[axis] = static_cast<int>(std::min(high, farthest));
  }
  return limits;
}

}

DifferingNodes::DifferingNodes(const ArrivalSearch& search, int stride, std::size_t most)
  : Search(search)
  , Stride(stride)
  , Most(most)
  , Limits(FindLimits(search.Bounds, stride * search.VoxelSize))
  , Numbers(Unknown)
  , Recent(this->Numbers)
{
  this->Flood(this->FindNearSurface());
}

bool DifferingNodes::AddFrom(const openvdb::Coord& place)
{
  const std::size_t before = this->Nodes.size();
  if (this->Visit(place))
  {
    this->Flood({ place });
  }
  return this->Nodes.size() > before;
}

DifferingNodes::Places DifferingNodes::FindDiffering(const Places& places) const
{
  const std::vector<double> values = this->EvaluateAt(places);
  Places differing;
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    if (this->Differs(places[i], values[i]))
    {
      differing.push_back(places[i]);
    }
  }
  return differing;
}

std::vector<double> DifferingNodes::FindCommonDepths(const Places& places, bool areInside) const
{
  std::vector<double> depths = this->EvaluateAt(places);
  const double sign = areInside ? -1.0 : 1.0;
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    const double ofTarget = sign * depths[i] / this->Search.VoxelSize;
    const double ofSurface = sign * this->ValueAt(places[i]);
    const bool isInBoth = this->Limits.isInside(places[i]) && ofTarget >= 0.0 && ofSurface >= 0.0;
    depths[i] = isInBoth ? std::min(ofTarget, ofSurface) : -1.0;
  }
  return depths;
}

std::int32_t DifferingNodes::FindNext(std::size_t i, int axis, int sign)
{
  openvdb::Coord place = this->Nodes[i].Place;
  place[axis] += sign;
  const std::int32_t next = this->Recent.getValue(place);
  return next >= 0 && this->Nodes[next].IsInside == this->Nodes[i].IsInside ? next : None;
}

double DifferingNodes::PotentialAt(const openvdb::Coord& place) const
{
  const double most = this->Stride;
  return std::min(std::max(this->ValueAt(place), -most), most);
}

openvdb::Coord DifferingNodes::FindNearest(const double point[3]) const
{
  openvdb::Coord nearest;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double low = this->Limits.min()[axis], high = this->Limits.max()[axis];
    const double place = std::round(point[axis] / this->GetSpacing());
    nearest[axis] = static_cast<int>(std::min(std::max(place, low), high));
  }
  return nearest;
}

DifferingNodes::Places DifferingNodes::FindNearSurface()
{
  Places places;
  for (std::size_t i = 0; i < this->Search.Leaves.Size(); ++i)
  {
    const BandLeaf& leaf = this->Search.Leaves[i];
    leaf.Active.ForEach(
      [&](int node)
      {
        const openvdb::Coord at = leaf.Origin.offsetBy(node >> 6, (node >> 3) & 7, node & 7);
        const openvdb::Coord place(
          at[0] / this->Stride, at[1] / this->Stride, at[2] / this->Stride);
        const bool isOn = at[0] == place[0] * this->Stride && at[1] == place[1] * this->Stride &&
          at[2] == place[2] * this->Stride;
        if (isOn && this->Visit(place))
        {
          places.push_back(place);
        }
      });
  }
  return places;
}

/** Marks a node as visited. Returns false if the node is outside the limits or already visited. */
bool DifferingNodes::Visit(const openvdb::Coord& place)
{
  if (!this->Limits.isInside(place) || this->Recent.getValue(place) != Unknown)
  {
    return false;
  }
  this->Recent.setValue(place, None);
  return true;
}

void DifferingNodes::Flood(Places places)
{
  while (!places.empty() && !this->IsCut())
  {
    const std::vector<double> values = this->EvaluateAt(places);
    Places next;
    this->AddDiffering(places, values, next);
    places = std::move(next);
  }
}

std::vector<double> DifferingNodes::EvaluateAt(const Places& places) const
{
  constexpr std::size_t batch = 128;
  std::vector<double> values(places.size());
  const auto evaluate = [&](std::size_t k)
  {
    const std::size_t first = batch * k, count = std::min(batch, places.size() - first);
    double points[3 * batch], slopes[batch];
    for (std::size_t i = 0; i < 3 * count; ++i)
    {
      points[i] = places[first + i / 3][i % 3] * this->GetSpacing();
    }
    this->Search.Target.Evaluate(count, points, { values.data() + first, slopes });
  };
  const std::size_t batches = (places.size() + batch - 1) / batch;
  if (this->Search.Target.IsThreadSafe())
  {
    tbb::parallel_for(std::size_t{ 0 }, batches, evaluate);
  }
  else
  {
    for (std::size_t k = 0; k < batches; ++k)
    {
      evaluate(k);
    }
  }
  return values;
}

void DifferingNodes::AddDiffering(
  const Places& places, const std::vector<double>& values, Places& next)
{
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    if (!this->Differs(places[i], values[i]))
    {
      continue;
    }
    this->Recent.setValue(places[i], static_cast<std::int32_t>(this->Nodes.size()));
    this->Nodes.push_back({ places[i], this->IsInside(places[i]), std::fabs(values[i]) });
    for (int face = 0; face < 6; ++face)
    {
      openvdb::Coord beside = places[i];
      beside[face / 2] += face % 2 ? 1 : -1;
      if (this->Visit(beside))
      {
        next.push_back(beside);
      }
    }
  }
}

}
