#include "Implicit/DisplacementLattice.h"

#include "Leaves/LeafExchange.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace activesurface
{

namespace
{

/** Displacements beyond it [voxels] are no motion: they count as unknown. */
constexpr double LongestRepresentable = 500.0;

/** 3 x 3 x 3 points of a leaf: a weight, 0 if the displacement is unknown, and its products with
 * the displacement along each axis. */
struct LeafPoints
{
  double Of[4][27];
};

/** Along one axis: the last of three points that a node is not before, and the weight of the next.
 * The weight is never 0, since a known point without weight is better than none. */
struct NodeWeights
{
  int Point[8];
  double Lower[8], Upper[8];

  explicit NodeWeights(double least)
  {
    for (int node = 0; node < 8; ++node)
    {
      const double t = .25 * (node & 3);
      this->Point[node] = node >> 2;
      this->Lower[node] = 1.0 - t;
      this->Upper[node] = std::max(t, least);
    }
  }
};

/** Linear interpolation, one axis after the other. */
void Expand(const double* points, const NodeWeights& weights, double* nodes)
{
  double alongZ[9][8], alongY[3][64];
  for (int row = 0; row < 9; ++row)
  {
    for (int z = 0; z < 8; ++z)
    {
      const double* point = points + 3 * row + weights.Point[z];
      alongZ[row][z] = weights.Lower[z] * point[0] + weights.Upper[z] * point[1];
    }
  }
  for (int plane = 0; plane < 3; ++plane)
  {
    for (int y = 0; y < 8; ++y)
    {
      const double* row = alongZ[3 * plane + weights.Point[y]];
      for (int z = 0; z < 8; ++z)
      {
        alongY[plane][8 * y + z] = weights.Lower[y] * row[z] + weights.Upper[y] * row[8 + z];
      }
    }
  }
  for (int x = 0; x < 8; ++x)
  {
    const double* plane = alongY[weights.Point[x]];
    for (int node = 0; node < 64; ++node)
    {
      nodes[64 * x + node] = weights.Lower[x] * plane[node] + weights.Upper[x] * plane[64 + node];
    }
  }
}

openvdb::Coord Corner(const openvdb::Coord& leaf, int eighth)
{
  return leaf.offsetBy(8 * (eighth >> 2), 8 * ((eighth >> 1) & 1), 8 * (eighth & 1));
}

}

void TargetDisplacements::Evaluate(
  std::size_t count, const double* points, double* displacements) const
{
  double places[3 * Most];
  std::transform(
    points, points + 3 * count, places, [this](double voxel) { return this->VoxelSize * voxel; });
  this->Source.EvaluateVelocities(count, places, displacements);
  for (std::size_t n = 0; n < 3 * count; ++n)
  {
    const double value = this->Factor * displacements[n];
    displacements[n] =
      std::fabs(value) <= LongestRepresentable ? value : std::numeric_limits<double>::quiet_NaN();
  }
}

DisplacementLattice::DisplacementLattice(const std::vector<openvdb::Coord>& leaves,
  const TargetDisplacements& displacements, LeafOwners* ranks)
{
  this->AddPoints(leaves);
  const std::size_t count = this->Leaves.size();
  ShareByOwners(
    ranks, count, [this](std::size_t n) { return this->Leaves[n].Leaf; },
    [&](auto&& evaluate) { displacements.ForEach(0, count, evaluate); },
    [&](std::size_t n) { this->Evaluate(this->Leaves[n], displacements); },
    [this](std::size_t n, auto& pass) { pass(&this->Leaves[n].Displacements[0][0], 24); });
}

/** A leaf wants its own points, and those on its upper sides, which are its neighbours' own. */
void DisplacementLattice::AddPoints(const std::vector<openvdb::Coord>& leaves)
{
  constexpr unsigned lowerOf[3] = { 0x0f, 0x33, 0x55 };
  std::vector<std::pair<openvdb::Coord, unsigned>> wanted;
  wanted.reserve(8 * leaves.size());
  for (const openvdb::Coord& leaf : leaves)
  {
    for (int corner = 0; corner < 8; ++corner)
    {
      const unsigned lower[3] = { corner & 4 ? lowerOf[0] : 0xff, corner & 2 ? lowerOf[1] : 0xff,
        corner & 1 ? lowerOf[2] : 0xff };
      wanted.emplace_back(Corner(leaf, corner), lower[0] & lower[1] & lower[2]);
    }
  }
  std::sort(wanted.begin(), wanted.end());
  for (const auto& [leaf, points] : wanted)
  {
    if (this->Leaves.empty() || this->Leaves.back().Leaf != leaf)
    {
      this->Leaves.emplace_back(Points{ leaf, 0, {} });
    }
    this->Leaves.back().Wanted |= points;
  }
}

void DisplacementLattice::Evaluate(Points& points, const TargetDisplacements& displacements) const
{
  double places[3 * 8], values[3 * 8];
  std::size_t count = 0;
  for (int n = 0; n < 8; ++n)
  {
    if ((points.Wanted >> n) & 1u)
    {
      const int eighth[3] = { n >> 2, (n >> 1) & 1, n & 1 };
      for (int axis = 0; axis < 3; ++axis)
      {
        places[3 * count + axis] = points.Leaf[axis] + 4 * eighth[axis];
      }
      ++count;
    }
  }
  displacements.Evaluate(count, places, values);
  const double* value = values;
  for (int n = 0; n < 8; ++n)
  {
    if ((points.Wanted >> n) & 1u)
    {
      std::copy_n(value, 3, points.Displacements[n]);
      value += 3;
    }
  }
}

const DisplacementLattice::Points& DisplacementLattice::PointsOf(const openvdb::Coord& leaf) const
{
  return *std::lower_bound(this->Leaves.begin(), this->Leaves.end(), leaf,
    [](const Points& points, const openvdb::Coord& origin) { return points.Leaf < origin; });
}

void DisplacementLattice::Interpolate(const openvdb::Coord& leaf, LeafDisplacements& values) const
{
  LeafPoints points;
  const Points* owners[8];
  for (int corner = 0; corner < 8; ++corner)
  {
    owners[corner] = &this->PointsOf(Corner(leaf, corner));
  }
  int known = 0;
  for (int n = 0; n < 27; ++n)
  {
    const int at[3] = { n / 9, n / 3 % 3, n % 3 };
    const int corner = 4 * (at[0] >> 1) + 2 * (at[1] >> 1) + (at[2] >> 1);
    const int eighth = 4 * (at[0] & 1) + 2 * (at[1] & 1) + (at[2] & 1);
    const double* value = owners[corner]->Displacements[eighth];
    const bool isKnown = IsKnown(value);
    known += isKnown;
    points.Of[3][n] = isKnown ? 1.0 : 0.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      points.Of[axis][n] = isKnown ? value[axis] : 0.0;
    }
  }
  if (known == 0)
  {
    values = {};
    return;
  }
  const bool all = known == 27;
  const NodeWeights weights(all ? 0.0 : 1e-6);
  for (int axis = 0; axis < 3; ++axis)
  {
    Expand(points.Of[axis], weights, values.Of[axis]);
  }
  values.Known = LeafMask::All();
  if (!all)
  {
    double sums[512];
    Expand(points.Of[3], weights, sums);
    for (int node = 0; node < 512; ++node)
    {
      if (!(sums[node] > 0.0))
      {
        values.Known.Remove(node);
        sums[node] = 1.0;
      }
    }
    for (auto& value : values.Of)
    {
      std::transform(
        value, value + 512, sums, value, [](double sum, double weight) { return sum / weight; });
    }
  }
}

}
