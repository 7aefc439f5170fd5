#include "RestingLeaves.h"

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
  table.ForEach([&](std::size_t i) { table[i].Speed.IsKnown = false; });
}

void ForgetChanged(LeafTable& table, double voxelSize, const Target& target)
{
  const LeafList changed = table.FindAll([&](const BandLeaf& leaf)
    { return leaf.Speed.IsKnown && MayHaveChanged(target, leaf.Origin, voxelSize); });
  for (const std::int32_t i : table.FindAround(changed))
  {
    table[i].Speed.IsKnown = false;
  }
}

LeafList FindUnknown(const LeafTable& table)
{
  return table.FindAll([](const BandLeaf& leaf) { return !leaf.Speed.IsKnown; });
}

void RememberSpeeds(LeafTable& table, const LeafList& leaves, const SubstepBuffers& buffers)
{
  table.ForEach(leaves,
    [&](std::size_t i)
    {
      LeafSpeed& speed = table[i].Speed;
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
    limits.Speed = std::max(limits.Speed, static_cast<double>(table[i].Speed.AtNodes));
    limits.Slope = std::max(limits.Slope, table[i].Speed.Slope);
  }
  return limits;
}

LeafList FindUnrest(
  LeafTable& table, const LeafList& measured, double rate, const SubstepBuffers& buffers)
{
  // A leaf that is too fast at its nodes moves, and is measured anew: it needs no more.
  const auto mayRest = [rate](const LeafSpeed& speed)
  { return speed.AtNodes <= NodesNearest * rate; };
  table.ForEach(measured,
    [&](std::size_t i)
    {
      LeafSpeed& speed = table[i].Speed;
      speed.AtSurface = mayRest(speed) ? LargestSpeedAtSurface(table, i, buffers) : 0.f;
    });
  return table.FindAll([&](const BandLeaf& leaf)
    { return !mayRest(leaf.Speed) || !(leaf.Speed.AtSurface <= Nearest * rate); });
}

}
