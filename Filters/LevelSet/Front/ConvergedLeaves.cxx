#include "Front/ConvergedLeaves.h"

#include "Front/StepForward.h"
#include "Front/SubstepBuffers.h"
#include "Front/TargetSpeed.h"

#include <algorithm>

namespace activesurface
{

namespace
{

constexpr double Nearest = 1e-3; // distance of a converged surface from the target [voxels]
/** Largest distance of the nodes of a crossed edge from the surface [voxels]. */
constexpr double NodesNearest = 1.0;

/** Coefficients of a step of dt = VoxelSize: u then changes by -speed * |grad u|. */
StepCoefficients CoefficientsOf(const ConvergenceRule& rule)
{
  StepCoefficients coefficients;
  coefficients.HasTargetSpeed = true;
  // Uses the scheme's differences at the nodes of crossed edges.
  coefficients.Central = rule.Parameters.Gradient == GradientScheme::Central;
  coefficients.Advection = 1.f;
  coefficients.Tension = static_cast<float>(rule.Parameters.Tension / rule.VoxelSize);
  return coefficients;
}

/** Target speed at a voxel's distance from the target. */
double SpeedOfVoxel(const ConvergenceRule& rule)
{
  return rule.VoxelSize * rule.Parameters.Attraction * rule.TargetSlope;
}

/**
 * Returns true if the target may have changed in the box that determines the speeds of a leaf. The
 * box includes the first nodes of the next leaves, because edges of the leaf end at these nodes,
 * and these nodes have edges too.
 */
bool MayHaveChanged(const Target& target, const openvdb::Coord& origin, double voxelSize)
{
  double bounds[6];
  for (int axis = 0; axis < 3; ++axis)
  {
    bounds[2 * axis] = voxelSize * (origin[axis] - 1);
    bounds[2 * axis + 1] = voxelSize * (origin[axis] + 9);
  }
  return target.MayHaveChanged(bounds);
}

}

void ForgetSpeeds(LeafTable& table)
{
  for (std::size_t i = 0; i < table.Size(); ++i)
  {
    table.SummaryOf(i).Speed.IsKnown = false;
  }
}

void ForgetChanged(LeafTable& table, double voxelSize, const Target& target)
{
  const LeafList changed = table.FindAll(
    [&](std::size_t i) {
      return table.SummaryOf(i).Speed.IsKnown && MayHaveChanged(target, table[i].Origin, voxelSize);
    });
  for (const std::int32_t i : table.FindAround(changed))
  {
    table.SummaryOf(i).Speed.IsKnown = false;
  }
}

LeafList FindUnknown(const LeafTable& table)
{
  return table.FindAll([&table](std::size_t i) { return !table.SummaryOf(i).Speed.IsKnown; });
}

void RememberSpeeds(LeafTable& table, const LeafList& leaves, const SubstepBuffers& buffers)
{
  table.ForEach(leaves,
    [&](std::size_t i)
    {
      LeafSpeed& speed = table.SummaryOf(i).Speed;
      speed.AtNodes = buffers.LargestSpeed[i];
      speed.TargetSlope = buffers.LargestTargetSlope[i];
      speed.IsKnown = true;
    });
}

TargetLimits FindLimits(const LeafTable& table)
{
  TargetLimits limits;
  for (std::size_t i = 0; i < table.Size(); ++i)
  {
    const LeafSpeed& speed = table.SummaryOf(i).Speed;
    limits.Speed = std::max(limits.Speed, static_cast<double>(speed.AtNodes));
    limits.TargetSlope = std::max(limits.TargetSlope, speed.TargetSlope);
  }
  return limits;
}

LeafList FindActiveLeaves(LeafTable& table, const LeafList& measured, const ConvergenceRule& rule,
  const SubstepBuffers& buffers)
{
  const double slow = Nearest * SpeedOfVoxel(rule);
  if (rule.Parameters.Tension != 0.0)
  {
    FindRates(table, measured, CoefficientsOf(rule), slow, buffers);
    return table.FindAll(
      [&](std::size_t i) { return !(table.SummaryOf(i).Speed.AtSurface <= slow); });
  }
  // A leaf with a high speed at its nodes has not converged, so AtSurface is not interpolated.
  const auto mayConverge = [fastest = NodesNearest * SpeedOfVoxel(rule)](const LeafSpeed& speed)
  { return speed.AtNodes <= fastest; };
  table.ForEach(measured,
    [&](std::size_t i)
    {
      LeafSpeed& speed = table.SummaryOf(i).Speed;
      speed.AtSurface =
        mayConverge(speed) ? LargestSpeedAtSurface(table, i, buffers) : speed.AtNodes;
    });
  return table.FindAll(
    [&](std::size_t i)
    {
      const LeafSpeed& speed = table.SummaryOf(i).Speed;
      return !mayConverge(speed) || !(speed.AtSurface <= slow);
    });
}

}
