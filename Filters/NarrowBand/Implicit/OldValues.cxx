#include "Implicit/OldValues.h"

#include <algorithm>
#include <cmath>

namespace activesurface
{

namespace
{

/** Weights of the nodes -1 .. 2 at t in [0,1): the cubic through them. It is stable at any
 * displacement. */
void FindWeights(double t, float weights[4])
{
  const double before = t + 1.0, after = t - 1.0, last = t - 2.0;
  weights[0] = static_cast<float>(-t * after * last / 6.0);
  weights[1] = static_cast<float>(before * after * last / 2.0);
  weights[2] = static_cast<float>(-before * t * last / 2.0);
  weights[3] = static_cast<float>(before * t * after / 6.0);
}

/** Feet that lie farther apart are looked up one by one. */
constexpr double MostGathered = 40.0 * 40.0 * 40.0;

bool IsFar(float value)
{
  return !(std::fabs(value) < .5f * Far);
}

}

OldValues::OldValues(const LeafTable& table, const PotentialTree& tree, const double* feet)
  : Tree(tree)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    double least = feet[axis], most = feet[axis];
    for (int node = 1; node < 512; ++node)
    {
      least = std::min(least, feet[3 * node + axis]);
      most = std::max(most, feet[3 * node + axis]);
    }
    this->First[axis] = static_cast<int>(std::floor(least)) - 1;
    this->Size[axis] = static_cast<int>(std::floor(most)) + 3 - this->First[axis];
  }
  double count = 1.0;
  for (int size : this->Size)
  {
    count *= size;
  }
  if (count <= MostGathered)
  {
    this->Values.resize(static_cast<std::size_t>(count));
    this->Gather(table, tree);
  }
}

void OldValues::Gather(const LeafTable& table, const PotentialTree& tree)
{
  const auto below = [](int voxel) { return voxel & ~7; };
  for (int x = below(this->First[0]); x < this->First[0] + this->Size[0]; x += 8)
  {
    for (int y = below(this->First[1]); y < this->First[1] + this->Size[1]; y += 8)
    {
      for (int z = below(this->First[2]); z < this->First[2] + this->Size[2]; z += 8)
      {
        this->GatherLeaf(table, tree, openvdb::Coord(x, y, z));
      }
    }
  }
}

void OldValues::GatherLeaf(
  const LeafTable& table, const PotentialTree& tree, const openvdb::Coord& origin)
{
  const std::int32_t number = table.Find(origin);
  const float tile = number >= 0 ? 0.f : tree.getValue(origin);
  int first[3], last[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    first[axis] = std::max(origin[axis], this->First[axis]);
    last[axis] = std::min(origin[axis] + 8, this->First[axis] + this->Size[axis]);
  }
  for (int x = first[0]; x < last[0]; ++x)
  {
    for (int y = first[1]; y < last[1]; ++y)
    {
      float* row = this->Values.data() + this->PlaceOf(x, y, first[2]);
      const int node = 64 * (x - origin[0]) + 8 * (y - origin[1]) + first[2] - origin[2];
      if (number >= 0)
      {
        std::copy_n(table[number].Value + node, last[2] - first[2], row);
      }
      else
      {
        std::fill_n(row, last[2] - first[2], tile);
      }
    }
  }
}

float OldValues::Interpolate(const double* foot) const
{
  int base[3];
  float weights[3][4];
  double part[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    base[axis] = static_cast<int>(std::floor(foot[axis]));
    part[axis] = foot[axis] - base[axis];
    FindWeights(part[axis], weights[axis]);
  }
  const auto valueAt = [&](int x, int y, int z)
  {
    return this->Values.empty()
      ? this->Tree.getValue(openvdb::Coord(base[0] + x, base[1] + y, base[2] + z))
      : this->Values[this->PlaceOf(base[0] + x, base[1] + y, base[2] + z)];
  };
  const float nearest = valueAt(part[0] >= .5, part[1] >= .5, part[2] >= .5);
  if (IsFar(nearest))
  {
    return nearest;
  }
  float cubic = 0.f, linear = 0.f;
  bool isCubic = true, isLinear = true;
  for (int x = 0; x < 4; ++x)
  {
    for (int y = 0; y < 4; ++y)
    {
      float sum = 0.f;
      for (int z = 0; z < 4; ++z)
      {
        const float value = valueAt(x - 1, y - 1, z - 1);
        sum += weights[2][z] * value;
        isCubic = isCubic && !IsFar(value);
      }
      cubic += weights[0][x] * weights[1][y] * sum;
    }
  }
  for (int corner = 0; corner < 8 && !isCubic; ++corner)
  {
    const int upper[3] = { corner >> 2, (corner >> 1) & 1, corner & 1 };
    float weight = 1.f;
    for (int axis = 0; axis < 3; ++axis)
    {
      weight *= static_cast<float>(upper[axis] ? part[axis] : 1.0 - part[axis]);
    }
    const float value = valueAt(upper[0], upper[1], upper[2]);
    linear += weight * value;
    isLinear = isLinear && (weight == 0.f || !IsFar(value));
  }
  return isCubic ? cubic : isLinear ? linear : std::copysign(Far, nearest);
}

}
