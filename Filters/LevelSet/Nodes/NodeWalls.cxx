// Walls and obstacle in the node scheme.

#include "Nodes/NodeStep.h"

#include "Base/Obstacle.h"
#include "Base/OpenVDB.h"

#include <algorithm>
#include <cmath>

namespace activesurface
{

namespace
{

/** Half the diagonal of a leaf's nodes, plus NodeLimit [voxels]. */
constexpr double ReachOfLeaf = 6.1 + NodeLimit;

/** Limits of the cosine between the normal of a surface and the direction to a wall. The shift onto
 * the wall has full weight from FacesWall on, and weight 0 up to LeavesWall. A free surface that
 * meets a wall, or a surface at an edge of the box, is therefore as round as without walls. */
constexpr float LeavesWall = .75f, FacesWall = .95f;

/** Distance from a wall from which on a surface is not shifted [gap]. */
constexpr float NoShift = 1.5f;

double DepthInWalls(const Walls& walls, const NodeIndex& node, double voxelSize)
{
  const double place[3] = { voxelSize * node[0], voxelSize * node[1], voxelSize * node[2] };
  return DistanceToWalls(walls, place) / voxelSize;
}

double DepthInObstacle(const Obstacle& solid, const NodeIndex& node, double voxelSize)
{
  const double place[3] = { voxelSize * node[0], voxelSize * node[1], voxelSize * node[2] };
  return solid.DepthAt(place) / voxelSize;
}

/** One side of the walls. */
struct WallSide
{
  int Axis;
  float Inward; //< direction into the box along the axis, +1 or -1
  double Place; //< coordinate [voxels]
};

/** Cosine between the gradient and the direction to a wall; 0 where the cosine is negative or the
 * gradient vanishes. */
float CosineToWall(const WallSide& side, const float (&gradient)[3])
{
  const float square =
    gradient[0] * gradient[0] + gradient[1] * gradient[1] + gradient[2] * gradient[2];
  const float towards = -side.Inward * gradient[side.Axis];
  return towards > 0.f ? towards / std::sqrt(square) : 0.f;
}

/** Returns the weight of the shift onto a wall for a surface at the distance `between` from the
 * wall: 1 up to `gap`, then falling to 0 at NoShift, so an approaching surface does not jump; times
 * the weight of the cosine. */
float WeightOfShift(float between, float cosine, float gap)
{
  const float facing = (cosine - LeavesWall) / (FacesWall - LeavesWall);
  const float share = std::min(std::max(facing, 0.f), 1.f);
  const float near =
    std::min(std::max((NoShift * gap / between - 1.f) / (NoShift - 1.f), 0.f), 1.f);
  return share * share * (3.f - 2.f * share) * near;
}

/** Returns the distance from the surface to a wall along the axis, found at a node at `distance`
 * from the wall. The crossing is interpolated, because the potential is no distance where particles
 * are about as wide as voxels. outward: offset to the next node towards the wall. */
float FindBetween(const float* potential, float distance, int outward)
{
  const bool isBeyond = distance <= 0.f;
  const float inner = potential[isBeyond ? -outward : 0], outer = potential[isBeyond ? 0 : outward];
  const float toWall = isBeyond ? distance + 1.f : distance; // from the inner node
  return toWall + (inner < 0.f && outer > 0.f ? inner / (outer - inner) : inner);
}

/** Changes the potential `numbers` at a leaf's nodes near a wall to the distance from the wall, so
 * that a surface that faces the wall rests on the wall. */
void RestOnWall(const WallSide& side, float gap, const NodeIndex& origin,
  const NodeBlock<1>& potential, float* numbers)
{
  constexpr int X = NodeBlock<1>::X, Y = NodeBlock<1>::Y;
  constexpr int offsets[3] = { X, Y, 1 };
  const int outward = (side.Inward > 0.f ? -1 : 1) * offsets[side.Axis];
  for (int n = 0; n < 512; ++n)
  {
    const int index[3] = { n >> 6, n >> 3 & 7, n & 7 };
    const auto distance =
      static_cast<float>(side.Inward * (origin[side.Axis] + index[side.Axis] - side.Place));
    const float* c = potential.Row(index[0], index[1]) + index[2];
    const float between = FindBetween(c, distance, outward);
    if (between > 0.f && between < NodeLimit)
    {
      const float gradient[3] = { c[X] - c[-X], c[Y] - c[-Y], c[1] - c[-1] };
      const float weight = WeightOfShift(between, CosineToWall(side, gradient), gap);
      numbers[n] -= weight * (numbers[n] + distance);
    }
  }
}

}

/** Adds leaves inside the target that the surface of a wall or of the obstacle may cross. */
void NodeStep::AddConfined(const NodeFrame& frame, const Motion& motion)
{
  std::vector<ShellLeaf>& shell = this->Near.Leaves;
  for (const NodeIndex& origin : this->Near.InsideLeaves)
  {
    const NodeIndex centre = CentreOf(origin);
    const bool isAtWall = motion.Box.Present &&
      std::fabs(DepthInWalls(motion.Box, centre, frame.VoxelSize)) < 2.0 * ReachOfLeaf;
    const bool isAtSolid = motion.Solid &&
      std::fabs(DepthInObstacle(*motion.Solid, centre, frame.VoxelSize)) < Obstacle::Reach;
    if (isAtWall || isAtSolid)
    {
      shell.push_back({ origin, 0, ~std::uint64_t(0) });
    }
  }
  std::sort(shell.begin(), shell.end(),
    [](const ShellLeaf& a, const ShellLeaf& b) { return a.Origin < b.Origin; });
}

void NodeStep::SampleSolid(std::size_t own, Obstacle& solid) const
{
  std::vector<Obstacle::LeafOrigin> origins;
  std::transform(this->Near.Leaves.begin(),
    this->Near.Leaves.begin() + static_cast<std::ptrdiff_t>(own), std::back_inserter(origins),
    [](const ShellLeaf& leaf) { return leaf.Origin; });
  solid.SampleLeaves(origins);
  solid.Check();
}

bool NodeStep::IsSolid(const NodeIndex& origin, const NodeFrame& frame, const Motion& motion) const
{
  const NodeIndex centre = CentreOf(origin);
  return (motion.Box.Present && DepthInWalls(motion.Box, centre, frame.VoxelSize) > 0.0) ||
    (motion.Solid && DepthInObstacle(*motion.Solid, centre, frame.VoxelSize) > 0.0);
}

/** Finds the depths of a leaf's nodes in walls and obstacle [voxels]. Returns false if no wall and
 * no obstacle is near. */
bool NodeStep::FindDepths(
  const NodeIndex& origin, const NodeFrame& frame, const Motion& motion, float (&depths)[512]) const
{
  const bool isAtWall = IsNearWall(origin, frame, motion);
  const float* solid = motion.Solid ? motion.Solid->FindDepths(origin) : nullptr;
  if (!isAtWall && !solid)
  {
    return false;
  }
  for (int n = 0; n < 512; ++n)
  {
    const NodeIndex node = { origin[0] + (n >> 6), origin[1] + (n >> 3 & 7), origin[2] + (n & 7) };
    const float wall =
      isAtWall ? static_cast<float>(DepthInWalls(motion.Box, node, frame.VoxelSize)) : -HUGE_VALF;
    depths[n] = std::max(wall, solid ? solid[n] : -HUGE_VALF);
  }
  return true;
}

bool NodeStep::IsNearWall(const NodeIndex& origin, const NodeFrame& frame, const Motion& motion)
{
  return motion.Box.Present &&
    DepthInWalls(motion.Box, CentreOf(origin), frame.VoxelSize) > -2.0 * ReachOfLeaf;
}

/** Shifts a surface that is near a wall, and faces the wall, onto the wall, where the surface is
 * then flat. The sides of a periodic box do not count as walls. gap: NodeTarget::GetWallGap,
 * limited so that the potential of a surface that is shifted partly is not clamped. Overwrites Psi.
 */
void NodeStep::RestOnWalls(const NodeFrame& frame, const Motion& motion, float gap)
{
  if (!motion.Box.Present || !(gap > 0.f))
  {
    return;
  }
  gap = std::min(gap, NodeLimit / NoShift);
  this->Halo.Refresh(this->Potential);
  const auto rest = [&](std::size_t i)
  {
    const NodeLeaf& leaf = this->Leaves[i];
    if (!IsNearWall(leaf.Origin, frame, motion))
    {
      return;
    }
    NodeBlock<1> potential;
    potential.Gather(this->Potential, leaf, NodeLimit);
    std::copy_n(this->Potential.Of(i), 512, this->Psi.Of(i));
    for (int wall = 0; wall < 6; ++wall)
    {
      if (!(motion.Period.Length[wall / 2] > 0.0))
      {
        const WallSide side = { wall / 2, wall % 2 == 0 ? 1.f : -1.f,
          motion.Box.Bounds[wall] / frame.VoxelSize };
        RestOnWall(side, gap, leaf.Origin, potential, this->Psi.Of(i));
      }
    }
  };
  this->Leaves.ForEach(rest);
  this->Leaves.ForEach(
    [&](std::size_t i)
    {
      if (IsNearWall(this->Leaves[i].Origin, frame, motion))
      {
        std::copy_n(this->Psi.Of(i), 512, this->Potential.Of(i));
      }
    });
}

/** Raises numbers to at least the depths in walls and obstacle, at most to NodeLimit. Sets Rows to
 * all rows in leaves near walls or obstacle. unit: of the numbers [voxels]. */
void NodeStep::Confine(
  NodeArrays& numbers, float unit, const NodeFrame& frame, const Motion& motion)
{
  if (!motion.Box.Present && !motion.Solid)
  {
    return;
  }
  this->Leaves.ForEach(
    [&](std::size_t i)
    {
      float depths[512];
      NodeLeaf& leaf = this->Leaves[i];
      if (!this->FindDepths(leaf.Origin, frame, motion, depths))
      {
        return;
      }
      leaf.Rows = ~std::uint64_t(0);
      float* values = numbers.Of(i);
      for (int n = 0; n < 512; ++n)
      {
        values[n] = std::min(std::max(values[n], depths[n] / unit), NodeLimit);
      }
    });
}

}
