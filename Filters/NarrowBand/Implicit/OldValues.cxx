#include "Implicit/OldValues.h"

#include <algorithm>
#include <cmath>

namespace activesurface
{

namespace
{

bool IsFar(float value)
{
  return !(std::fabs(value) < .5f * Far);
}

int Floor(double value)
{
  const int towardsZero = static_cast<int>(value);
  return towardsZero - (value < towardsZero ? 1 : 0);
}

/** Along one axis: the node below, and the weights of the nodes -1 .. 2 from it: the cubic through
 * them. It is stable at any displacement. */
struct CubicWeights
{
  int Below;
  double Part;
  float Of[4];

  explicit CubicWeights(double foot)
    : Below(Floor(foot))
    , Part(foot - this->Below)
  {
    const double t = this->Part, before = t + 1.0, after = t - 1.0, last = t - 2.0;
    this->Of[0] = static_cast<float>(-t * after * last * (1.0 / 6.0));
    this->Of[1] = static_cast<float>(before * after * last * .5);
    this->Of[2] = static_cast<float>(-before * t * last * .5);
    this->Of[3] = static_cast<float>(before * t * after * (1.0 / 6.0));
  }
};

/** 4 x 4 x 4 nodes: the values of rows of four along z. */
struct Neighbourhood
{
  const float* First;
  int StrideX, StrideY;

  const float* Row(int x, int y) const
  {
    return this->First + x * this->StrideX + y * this->StrideY;
  }
};

/** Far if one of the nodes is. */
float InterpolateCubic(const Neighbourhood& values, const CubicWeights weights[3])
{
  float sums[4] = {}, largest[4] = {};
  for (int x = 0; x < 4; ++x)
  {
    for (int y = 0; y < 4; ++y)
    {
      const float weight = weights[0].Of[x] * weights[1].Of[y];
      const float* row = values.Row(x, y);
      for (int z = 0; z < 4; ++z)
      {
        sums[z] += weight * row[z];
        largest[z] = std::max(largest[z], std::fabs(row[z]));
      }
    }
  }
  if (IsFar(std::max(std::max(largest[0], largest[1]), std::max(largest[2], largest[3]))))
  {
    return Far;
  }
  const float* w = weights[2].Of;
  return (w[0] * sums[0] + w[1] * sums[1]) + (w[2] * sums[2] + w[3] * sums[3]);
}

/** Far if one of the nodes that have a weight is. */
float InterpolateLinearly(const Neighbourhood& values, const CubicWeights weights[3])
{
  float sum = 0.f;
  for (int corner = 0; corner < 8; ++corner)
  {
    const int upper[3] = { corner >> 2, (corner >> 1) & 1, corner & 1 };
    float weight = 1.f;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double part = weights[axis].Part;
      weight *= static_cast<float>(upper[axis] ? part : 1.0 - part);
    }
    const float value = values.Row(1 + upper[0], 1 + upper[1])[1 + upper[2]];
    if (weight != 0.f && IsFar(value))
    {
      return Far;
    }
    sum += weight * value;
  }
  return sum;
}

}

OldValues::OldValues(const LeafTable& table, const PotentialTree& tree, const LeafFeet& feet)
  : Table(table)
  , Tree(tree)
  , Feet(feet)
{
  this->FindBox();
  double count = 1.0;
  for (int size : this->Size)
  {
    count *= size;
  }
  this->IsGathered = count <= MostGathered;
  if (this->IsGathered)
  {
    this->Gather();
  }
}

void OldValues::FindBox()
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto [least, most] = std::minmax_element(this->Feet.At[axis], this->Feet.At[axis] + 512);
    this->First[axis] = Floor(*least) - 1;
    this->Size[axis] = Floor(*most) + 3 - this->First[axis];
  }
}

void OldValues::Gather()
{
  this->HasLayers = false;
  const auto below = [](int voxel) { return voxel & ~7; };
  for (int x = below(this->First[0]); x < this->First[0] + this->Size[0]; x += 8)
  {
    for (int y = below(this->First[1]); y < this->First[1] + this->Size[1]; y += 8)
    {
      for (int z = below(this->First[2]); z < this->First[2] + this->Size[2]; z += 8)
      {
        this->GatherLeaf(openvdb::Coord(x, y, z));
      }
    }
  }
}

void OldValues::GatherLeaf(const openvdb::Coord& origin)
{
  const std::int32_t number = this->Table.Find(origin);
  const float tile = number >= 0 ? 0.f : this->Tree.getValue(origin);
  this->HasLayers =
    this->HasLayers || (number >= 0 && this->Table[number].UpToLayer[LastLayer].Any());
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
      float* row = this->Values + this->PlaceOf(x, y, first[2]);
      const int node = 64 * (x - origin[0]) + 8 * (y - origin[1]) + first[2] - origin[2];
      if (number >= 0)
      {
        std::copy_n(this->Table[number].Value + node, last[2] - first[2], row);
      }
      else
      {
        std::fill_n(row, last[2] - first[2], tile);
      }
    }
  }
}

bool OldValues::IsUniform() const
{
  const float value = this->Values[0];
  return this->IsGathered && !this->HasLayers &&
    std::all_of(this->Values, this->Values + this->Size[0] * this->Size[1] * this->Size[2],
      [value](float other) { return other == value; });
}

float OldValues::Interpolate(int node) const
{
  const CubicWeights weights[3] = { CubicWeights(this->Feet.At[0][node]),
    CubicWeights(this->Feet.At[1][node]), CubicWeights(this->Feet.At[2][node]) };
  const int first[3] = { weights[0].Below - 1, weights[1].Below - 1, weights[2].Below - 1 };
  float lookedUp[64];
  if (!this->IsGathered)
  {
    for (int n = 0; n < 64; ++n)
    {
      lookedUp[n] = this->Tree.getValue(
        openvdb::Coord(first[0] + n / 16, first[1] + n / 4 % 4, first[2] + n % 4));
    }
  }
  const Neighbourhood values = this->IsGathered
    ? Neighbourhood{ this->Values + this->PlaceOf(first[0], first[1], first[2]),
        this->Size[1] * this->Size[2], this->Size[2] }
    : Neighbourhood{ lookedUp, 16, 4 };
  const auto nearer = [&weights](int axis) { return weights[axis].Part >= .5 ? 2 : 1; };
  const float nearest = values.Row(nearer(0), nearer(1))[nearer(2)];
  if (IsFar(nearest))
  {
    return nearest;
  }
  const float cubic = InterpolateCubic(values, weights);
  const float value = IsFar(cubic) ? InterpolateLinearly(values, weights) : cubic;
  return IsFar(value) ? std::copysign(Far, nearest) : value;
}

}
