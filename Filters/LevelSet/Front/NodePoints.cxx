#include "Front/NodePoints.h"

#include "Base/OpenVDB.h"
#include "Base/Trilinear.h"

#include <openvdb/tree/ValueAccessor.h>

#include <algorithm>
#include <cmath>

namespace activesurface
{

namespace
{

using Potential = openvdb::tree::ValueAccessor<const PotentialTree, false>;

/** Interpolates u at a point in voxels. */
double Interpolate(const Potential& potential, const double x[3])
{
  const openvdb::Coord low(static_cast<int>(std::floor(x[0])), static_cast<int>(std::floor(x[1])),
    static_cast<int>(std::floor(x[2])));
  double value[8];
  for (int corner = 0; corner < 8; ++corner)
  {
    value[corner] = potential.getValue(low.offsetBy(corner >> 2, corner >> 1 & 1, corner & 1));
  }
  const double t[3] = { x[0] - low[0], x[1] - low[1], x[2] - low[2] };
  return Trilinear(value, t, nullptr);
}

/** Moves a point of the band along the gradient to the surface. The point does not move where the
 * gradient vanishes: on a medial axis, where the closest point is not unique. */
void MoveToSurface(const Potential& potential, double x[3])
{
  constexpr int mostSteps = 8;
  constexpr double longest = 1.5; // voxels; a longer step would leave the layers
  for (int step = 0; step < mostSteps; ++step)
  {
    const double value = Interpolate(potential, x);
    double gradient[3], square = 0.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      double low[3] = { x[0], x[1], x[2] }, high[3] = { x[0], x[1], x[2] };
      low[axis] -= .5;
      high[axis] += .5;
      gradient[axis] = Interpolate(potential, high) - Interpolate(potential, low);
      square += gradient[axis] * gradient[axis];
    }
    if (square < 1e-8 || std::fabs(value) < 1e-9)
    {
      return;
    }
    const double length = std::fabs(value) / std::sqrt(square);
    const double shift = value / square * std::min(1.0, longest / std::max(length, longest));
    for (int axis = 0; axis < 3; ++axis)
    {
      x[axis] -= shift * gradient[axis];
    }
  }
}

}

LeafMask NodesWithOwnPoint(const LeafTable& table, const BandLeaf& leaf, const Motion& motion)
{
  if (!SamplesCrossings(motion))
  {
    return leaf.Active;
  }
  return motion.Paper ? leaf.Active.Without(NodesWithCrossing(table, leaf)) : LeafMask();
}

double* WriteNodePoints(
  const SampledLattice& lattice, std::size_t leaf, const Motion& motion, double* point)
{
  const Potential values(lattice.Potential);
  const openvdb::Coord& origin = lattice.Leaves[leaf].Origin;
  NodesWithOwnPoint(lattice.Leaves, lattice.Leaves[leaf], motion)
    .ForEach(
      [&](int node)
      {
        double x[3] = { double(origin[0] + (node >> 6)), double(origin[1] + ((node >> 3) & 7)),
          double(origin[2] + (node & 7)) };
        if (motion.Evaluation == TargetEvaluation::ClosestPoint)
        {
          MoveToSurface(values, x);
        }
        for (double coordinate : x)
        {
          *point++ = lattice.VoxelSize * coordinate;
        }
      });
  return point;
}

}
