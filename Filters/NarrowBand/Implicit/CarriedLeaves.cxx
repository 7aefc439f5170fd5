#include "Implicit/CarriedLeaves.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace activesurface
{

namespace
{

/** Displacements below it [voxels] are none: leaves at rest are left as they are. */
constexpr double Still = 1e-4;

/** Displacements beyond it [voxels] are no motion: they count as unknown. */
constexpr double Longest = 500.0;

/** By so much the surface of a leaf may go beside what its points say [voxels]. */
constexpr int Margin = 2;

bool IsKnown(const double* displacement)
{
  return std::isfinite(displacement[0] + displacement[1] + displacement[2]);
}

struct Ways
{
  double Least[3] = { HUGE_VAL, HUGE_VAL, HUGE_VAL };
  double Most[3] = { -HUGE_VAL, -HUGE_VAL, -HUGE_VAL };
  double Largest = 0.0; //< component

  void Add(const double* displacement)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Least[axis] = std::min(this->Least[axis], displacement[axis]);
      this->Most[axis] = std::max(this->Most[axis], displacement[axis]);
      this->Largest = std::max(this->Largest, std::fabs(displacement[axis]));
    }
  }
};

int OriginBelow(double voxel)
{
  return 8 * static_cast<int>(std::floor(voxel / 8.0));
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
    const double way = this->Factor * displacements[n];
    displacements[n] = std::fabs(way) <= Longest ? way : std::numeric_limits<double>::quiet_NaN();
  }
}

CarriedLeaves::CarriedLeaves(const LeafTable& table, const TargetDisplacements& displacements)
  : Displacements(3 * PointsPerLeaf * table.Size(), std::numeric_limits<double>::quiet_NaN())
{
  const auto sample = [&](std::size_t i) { this->Sample(table, displacements, i); };
  if (displacements.IsThreadSafe())
  {
    table.ForEach(sample);
  }
  else
  {
    for (std::size_t i = 0; i < table.Size(); ++i)
    {
      sample(i);
    }
  }
  for (std::size_t i = 0; i < table.Size(); ++i)
  {
    this->AddWay(table[i], this->Displacements.data() + 3 * PointsPerLeaf * i);
  }
  std::sort(this->Origins.begin(), this->Origins.end());
  this->Origins.erase(std::unique(this->Origins.begin(), this->Origins.end()), this->Origins.end());
}

void CarriedLeaves::Sample(
  const LeafTable& table, const TargetDisplacements& displacements, std::size_t i)
{
  if (!table.SummaryOf(i).IsUsed)
  {
    return;
  }
  double points[3 * PointsPerLeaf];
  for (int n = 0; n < PointsPerLeaf; ++n)
  {
    const int eighth[3] = { n >> 2, (n >> 1) & 1, n & 1 };
    for (int axis = 0; axis < 3; ++axis)
    {
      points[3 * n + axis] = table[i].Origin[axis] + 1.5 + 4 * eighth[axis];
    }
  }
  displacements.Evaluate(PointsPerLeaf, points, this->Displacements.data() + 3 * PointsPerLeaf * i);
}

/** The leaves on the way, in strides of half a leaf. */
void CarriedLeaves::AddWay(const BandLeaf& leaf, const double* displacements)
{
  Ways ways;
  for (int n = 0; n < PointsPerLeaf; ++n)
  {
    if (IsKnown(displacements + 3 * n))
    {
      ways.Add(displacements + 3 * n);
    }
  }
  if (!(ways.Largest > Still))
  {
    return;
  }
  const int strides = std::max(1, static_cast<int>(std::ceil(ways.Largest / 4.0)));
  for (int stride = 0; stride <= strides; ++stride)
  {
    const double done = static_cast<double>(stride) / strides;
    int first[3], last[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      first[axis] = OriginBelow(leaf.Origin[axis] + done * ways.Least[axis] - Margin);
      last[axis] = OriginBelow(leaf.Origin[axis] + 7 + done * ways.Most[axis] + Margin);
    }
    for (int x = first[0]; x <= last[0]; x += 8)
    {
      for (int y = first[1]; y <= last[1]; y += 8)
      {
        for (int z = first[2]; z <= last[2]; z += 8)
        {
          this->Origins.emplace_back(x, y, z);
        }
      }
    }
  }
}

double CarriedLeaves::GetLongest() const
{
  double longest = 0.0;
  for (std::size_t n = 0; n < this->Displacements.size(); n += 3)
  {
    const double* way = this->Displacements.data() + n;
    longest = IsKnown(way) ? std::max(longest, std::hypot(way[0], way[1], way[2])) : longest;
  }
  return longest;
}

bool CarriedLeaves::HasLeft(std::int32_t leaf, int node) const
{
  const int eighth = 4 * (node >> 8) + 2 * ((node >> 5) & 1) + ((node >> 2) & 1);
  return IsKnown(this->Displacements.data() + 3 * (PointsPerLeaf * leaf + eighth));
}

}
