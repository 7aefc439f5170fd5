#include "RestingLeaves.h"

#include "StepForward.h"
#include "SubstepBuffers.h"
#include "TargetSpeed.h"

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

bool MayHaveChanged(const Target& target, const openvdb::Coord& origin, double voxelSize)
{
  double bounds[6];
  for (int axis = 0; axis < 3; ++axis)
  {
    bounds[2 * axis] = voxelSize * origin[axis];
    bounds[2 * axis + 1] = voxelSize * (origin[axis] + 8); // edges end in the next leaf
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
  if (rule.Motion.Tension > 0.0)
  {
    FindRates(table, measured, CoefficientsOf(rule), slow, buffers);
  }
  else
  {
    table.ForEach(measured,
      [&](std::size_t i)
      {
        LeafSpeed& speed = table.SummaryOf(i).Speed;
        // One that is too fast at its nodes moves, and is measured anew: it needs no more.
        const bool mayRest = speed.AtNodes <= NodesNearest * SpeedOfVoxel(rule);
        speed.AtSurface = mayRest ? LargestSpeedAtSurface(table, i, buffers) : speed.AtNodes;
      });
  }
  return table.FindAll(
    [&](std::size_t i) { return !(table.SummaryOf(i).Speed.AtSurface <= slow); });
}

}
