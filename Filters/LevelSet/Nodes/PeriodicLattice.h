/**
 * Maps nodes beyond the sides of a periodic box to the positions in the box that the nodes repeat.
 */
#ifndef PeriodicLattice_h
#define PeriodicLattice_h

#include "Base/IndexMap.h"
#include "Base/Walls.h"

#include <cmath>

namespace activesurface
{

class PeriodicLattice
{
public:
  PeriodicLattice(const Periods& periods, double voxelSize)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Low[axis] = periods.Low[axis] / voxelSize;
      this->Length[axis] = periods.Length[axis] / voxelSize;
    }
  }

  /** Returns true if all nodes of a leaf are within the sides. */
  bool IsWithin(const NodeIndex& origin) const
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const bool isWithin =
        origin[axis] >= this->Low[axis] && origin[axis] + 7 <= this->Low[axis] + this->Length[axis];
      if (this->Length[axis] > 0.0 && !isWithin)
      {
        return false;
      }
    }
    return true;
  }

  /** Returns the value at a node within the sides. For a node beyond a side, returns the value at
   * the repeated position, interpolated linearly between the nodes around this position. */
  template <class ValueAt>
  float Interpolate(const NodeIndex& node, ValueAt&& valueAt) const
  {
    NodeIndex lower;
    float part[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      const double place = this->Wrap(axis, node[axis]);
      lower[axis] = static_cast<int>(std::floor(place));
      part[axis] = static_cast<float>(place - lower[axis]);
    }
    float sum = 0.f;
    for (int corner = 0; corner < 8; ++corner)
    {
      const NodeIndex at = { lower[0] + (corner & 1), lower[1] + (corner >> 1 & 1),
        lower[2] + (corner >> 2) };
      float weight = 1.f;
      for (int axis = 0; axis < 3; ++axis)
      {
        weight *= at[axis] > lower[axis] ? part[axis] : 1.f - part[axis];
      }
      sum += weight > 0.f ? weight * valueAt(at) : 0.f;
    }
    return sum;
  }

private:
  /** Returns the coordinate [voxels] that a node beyond a side repeats, or the node's own
   * coordinate. Coordinates within 1e-6 voxel of a side or a node count as on the side or the node.
   */
  double Wrap(int axis, int node) const
  {
    constexpr double rounding = 1e-6;
    const double length = this->Length[axis], away = node - this->Low[axis];
    if (!(length > 0.0) || (away >= -rounding && away <= length + rounding))
    {
      return node;
    }
    const double place = node - length * std::floor(away / length);
    const double nearest = std::round(place);
    return std::fabs(place - nearest) < rounding ? nearest : place;
  }

  double Low[3], Length[3]; //< [voxels]
};

}

#endif
