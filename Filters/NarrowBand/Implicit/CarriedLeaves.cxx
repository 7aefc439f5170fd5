#include "Implicit/CarriedLeaves.h"

#include "Leaves/LeafExchange.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace activesurface
{

namespace
{

/** Displacements below it [voxels] are none: leaves at rest are left as they are. */
constexpr double Still = 1e-4;

/** By so much the surface of a leaf may go beside what its points say [voxels]. */
constexpr int Margin = 2;

struct DisplacementExtent
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

/** Which coordinates the nodes of a mask have within their leaf. */
struct NodeBox
{
  int First[3] = { 8, 8, 8 };
  int Last[3] = { -1, -1, -1 };

  explicit NodeBox(const LeafMask& nodes)
  {
    std::uint64_t all = 0; // of the planes
    for (int x = 0; x < 8; ++x)
    {
      all |= nodes.Word[x];
      this->Add(0, x, nodes.Word[x] != 0);
    }
    for (int n = 0; n < 8; ++n)
    {
      this->Add(1, n, (all & (0xffull << (8 * n))) != 0);
      this->Add(2, n, (all & (0x0101010101010101ull << n)) != 0);
    }
  }

  bool IsEmpty() const { return this->Last[0] < 0; }

private:
  void Add(int axis, int coordinate, bool hasNodes)
  {
    if (hasNodes)
    {
      this->First[axis] = std::min(this->First[axis], coordinate);
      this->Last[axis] = coordinate;
    }
  }
};

int OriginBelow(double voxel)
{
  return 8 * static_cast<int>(std::floor(voxel / 8.0));
}

}

CarriedLeaves::CarriedLeaves(const LeafTable& table, const TargetDisplacements& displacements)
  : Displacements(3 * PointsPerLeaf * table.Size(), std::numeric_limits<double>::quiet_NaN())
{
  displacements.ForEach(
    0, table.Size(), [&](std::size_t i) { this->Sample(table, displacements, i); });
  TellAll(table,
    [this](std::size_t i, auto& pass)
    { pass(this->Displacements.data() + 3 * PointsPerLeaf * i, 3 * PointsPerLeaf); });
  this->FindOrigins(table);
}

void CarriedLeaves::Sample(
  const LeafTable& table, const TargetDisplacements& displacements, std::size_t i)
{
  if (!table.IsOwn(i) || !table.SummaryOf(i).IsUsed)
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

void CarriedLeaves::FindOrigins(const LeafTable& table)
{
  std::vector<char> isCarried(table.Size());
  for (std::size_t i = 0; i < table.Size(); ++i)
  {
    this->AddDisplacement(table, i, isCarried);
  }
  for (std::size_t i = 0; i < table.Size(); ++i)
  {
    if (isCarried[i])
    {
      this->Origins.push_back(table[i].Origin);
    }
  }
  std::sort(this->Origins.begin(), this->Origins.end());
  this->Origins.erase(std::unique(this->Origins.begin(), this->Origins.end()), this->Origins.end());
}

/** The leaf, which its surface may leave, and those that its band comes to, in strides of half a
 * leaf: leaves of the table are marked, others become origins. */
void CarriedLeaves::AddDisplacement(
  const LeafTable& table, std::size_t i, std::vector<char>& isCarried)
{
  DisplacementExtent extent;
  for (int n = 0; n < PointsPerLeaf; ++n)
  {
    const double* displacement = this->Displacements.data() + 3 * (PointsPerLeaf * i + n);
    if (IsKnown(displacement))
    {
      extent.Add(displacement);
    }
  }
  if (!(extent.Largest > Still))
  {
    return;
  }
  isCarried[i] = 1;
  const NodeBox band(table[i].UpToLayer[LastBandLayer]);
  const int strides = std::max(1, static_cast<int>(std::ceil(extent.Largest / 4.0)));
  for (int stride = 0; stride <= strides && !band.IsEmpty(); ++stride)
  {
    const double done = static_cast<double>(stride) / strides;
    int first[3], last[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      const int origin = table[i].Origin[axis];
      first[axis] = OriginBelow(origin + band.First[axis] + done * extent.Least[axis] - Margin);
      last[axis] = OriginBelow(origin + band.Last[axis] + done * extent.Most[axis] + Margin);
    }
    for (int x = first[0]; x <= last[0]; x += 8)
    {
      for (int y = first[1]; y <= last[1]; y += 8)
      {
        for (int z = first[2]; z <= last[2]; z += 8)
        {
          const openvdb::Coord origin(x, y, z);
          const std::int32_t number = table.Find(origin);
          number >= 0 ? void(isCarried[number] = 1) : this->Origins.push_back(origin);
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
    const double* d = this->Displacements.data() + n;
    longest = IsKnown(d) ? std::max(longest, std::hypot(d[0], d[1], d[2])) : longest;
  }
  return longest;
}

bool CarriedLeaves::HasLeft(std::int32_t leaf, int node) const
{
  const int eighth = 4 * (node >> 8) + 2 * ((node >> 5) & 1) + ((node >> 2) & 1);
  return IsKnown(this->Displacements.data() + 3 * (PointsPerLeaf * leaf + eighth));
}

}
