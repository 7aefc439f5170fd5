#include "Substep/RestingLeaves.h"

#include "Substep/StepForward.h"
#include "Substep/SubstepBuffers.h"
#include "Substep/TargetSpeed.h"

#include <algorithm>

namespace activesurface
{

namespace
{

constexpr double Nearest = 1e-3; // voxels
/** Nodes of a crossed edge are up to a voxel off the surface. */
constexpr double NodesNearest = 1.0;

/** Of a step that moves the surface by its speed. */
StepCoefficients CoefficientsOf(const RestRule& rule)
{
  StepCoefficients coefficients;
  coefficients.Attracted = true;
  coefficients.Central = rule.Motion.Gradient == GradientScheme::Central;
  coefficients.Advection = 1.f;
  coefficients.Tension = static_cast<float>(rule.Motion.Tension / rule.VoxelSize);
  return coefficients;
}

/** What a voxel from the target means. */
double SpeedOfVoxel(const RestRule& rule)
{
  return rule.VoxelSize * rule.Motion.Attraction * rule.Slope;
}

/** Where a leaf's speeds depend on the target: its edges end in the next leaves, and the nodes
 * there have edges of their own. */
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
      speed.Slope = buffers.LargestSlope[i];
      speed.IsKnown = true;
    });
}

TargetLimits FindLimits(const LeafTable& table)
{
  TargetLimits limits;
  for (std::size_t i = 0; i < table.Size(); ++i)
  {
    limits.Speed = std::max(limits.Speed, static_cast<double>(table.SummaryOf(i).Speed.AtNodes));
    limits.Slope = std::max(limits.Slope, table.SummaryOf(i).Speed.Slope);
  }
  return limits;
}

LeafList FindUnrest(
  LeafTable& table, const LeafList& measured, const RestRule& rule, const SubstepBuffers& buffers)
{
  const double slow = Nearest * SpeedOfVoxel(rule);
  if (rule.Motion.Tension != 0.0)
  {
    FindRates(table, measured, CoefficientsOf(rule), slow, buffers);
    return table.FindAll(
      [&](std::size_t i) { return !(table.SummaryOf(i).Speed.AtSurface <= slow); });
  }
  // A leaf that is too fast at its nodes moves, and is measured anew: it needs no more.
  const auto mayRest = [fastest = NodesNearest * SpeedOfVoxel(rule)](const LeafSpeed& speed)
  { return speed.AtNodes <= fastest; };
  table.ForEach(measured,
    [&](std::size_t i)
    {
      LeafSpeed& speed = table.SummaryOf(i).Speed;
      speed.AtSurface = mayRest(speed) ? LargestSpeedAtSurface(table, i, buffers) : speed.AtNodes;
    });
  return table.FindAll(
    [&](std::size_t i)
    {
      const LeafSpeed& speed = table.SummaryOf(i).Speed;
      return !mayRest(speed) || !(speed.AtSurface <= slow);
    });
}

}
