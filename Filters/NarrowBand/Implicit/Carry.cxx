#include "Implicit/Carry.h"

#include "Implicit/CarriedLeaves.h"
#include "Implicit/DisplacementLattice.h"
#include "Implicit/OldValues.h"
#include "Leaves/GhostFill.h"
#include "Leaves/Layers.h"
#include "Leaves/LeafExchange.h"
#include "Leaves/LeafKernels.h"
#include "Leaves/WholeBand.h"
#include "Substep/ConvergedLeaves.h"
#include "Substep/StepForward.h"
#include "Substep/SubstepBuffers.h"
#include "Substep/WalledTarget.h"

#include <algorithm>
#include <cmath>

namespace activesurface
{

namespace
{

/** The values of the carried leaves, not yet in the potential. */
struct CarriedValues
{
  const std::vector<openvdb::Coord>& Origins;
  NodeArrays& Values;
  std::vector<LeafMask> Known; //< nodes whose value is one of u, not only a side
  std::vector<char> Differs;   //< whether the leaf differs from a tile that it is
};

/** All nodes of a carried leaf. */
class CarryLeaf
{
public:
  CarryLeaf(const LeafTable& table, const PotentialTree& tree, const CarriedLeaves& carried,
    const DisplacementLattice& lattice, CarriedValues& result)
    : Table(table)
    , Tree(tree)
    , Carried(carried)
    , Lattice(lattice)
    , Result(result)
  {
  }

  void operator()(std::size_t n) const
  {
    const openvdb::Coord origin = this->Result.Origins[n];
    LeafDisplacements displacements;
    this->Lattice.Interpolate(origin, displacements);
    LeafFeet feet;
    for (int node = 0; node < 512; ++node)
    {
      const int at[3] = { node >> 6, (node >> 3) & 7, node & 7 };
      for (int axis = 0; axis < 3; ++axis)
      {
        feet.At[axis][node] = origin[axis] + at[axis] - displacements.Of[axis][node];
      }
    }
    this->Interpolate(n, feet, this->FindLeft(origin, displacements.Known));
  }

private:
  /** Where nothing is any more. */
  LeafMask FindLeft(const openvdb::Coord& origin, const LeafMask& known) const
  {
    LeafMask left;
    const std::int32_t number = this->Table.Find(origin);
    if (number >= 0)
    {
      LeafMask::All().Without(known).ForEach(
        [&](int node)
        {
          if (this->Carried.HasLeft(number, node))
          {
            left.Add(node);
          }
        });
    }
    return left;
  }

  void Interpolate(std::size_t n, const LeafFeet& feet, const LeafMask& left) const
  {
    const OldValues old(this->Table, this->Tree, feet);
    const bool isUniform = old.IsUniform();
    const float uniform = isUniform ? old.Interpolate(0) : 0.f;
    float* values = this->Result.Values.Of(n);
    LeafMask known;
    for (int node = 0; node < 512; ++node)
    {
      values[node] = left.Has(node) ? Far : isUniform ? uniform : old.Interpolate(node);
      if (std::fabs(values[node]) < .5f * Far)
      {
        known.Add(node);
      }
    }
    this->Result.Known[n] = known;
    const float before = this->Tree.getValue(this->Result.Origins[n]);
    this->Result.Differs[n] = known.Any() ||
      std::any_of(values, values + 512, [before](float v) { return (v < 0.f) != (before < 0.f); });
  }

  const LeafTable& Table;
  const PotentialTree& Tree;
  const CarriedLeaves& Carried;
  const DisplacementLattice& Lattice;
  CarriedValues& Result;
};

/** Of ranks each has room for its own ones. */
void MakeRoomFor(
  const std::vector<openvdb::Coord>& origins, const LeafOwners* ranks, NodeArrays& values)
{
  if (!ranks)
  {
    values.MakeRoom(origins.size());
    return;
  }
  LeafSlots slots;
  slots.Resize(origins.size());
  for (std::size_t n = 0; n < origins.size(); ++n)
  {
    if (ranks->FindOwner(origins[n]) == ranks->GetRank())
    {
      slots.Give(n);
    }
  }
  values.MakeRoom(slots);
}

/** Ranks carry their own leaves; where leaves are to be added is told to all. */
void CarryLeaves(const LeafTable& table, const CarryLeaf& carry, CarriedValues& carried)
{
  const std::size_t count = carried.Origins.size();
  ShareByOwners(
    table.GetRanks(), count, [&carried](std::size_t n) { return carried.Origins[n]; },
    [count](auto&& carryOne) { tbb::parallel_for(std::size_t(0), count, carryOne); }, carry,
    [&carried](std::size_t n, auto& pass) { pass(&carried.Differs[n], 1); });
}

/** Takes the values; returns the numbers of the leaves, ascending. */
LeafList TakeValues(const FollowingBand& band, const CarriedValues& carried)
{
  std::vector<openvdb::Coord> wanted;
  for (std::size_t n = 0; n < carried.Origins.size(); ++n)
  {
    if (carried.Differs[n])
    {
      wanted.push_back(carried.Origins[n]);
    }
  }
  MarkValuesChanged(band.Leaves);
  band.Leaves.Add(wanted, band.Potential);
  LeafList numbers;
  for (std::size_t n = 0; n < carried.Origins.size(); ++n)
  {
    const std::int32_t number = band.Leaves.Find(carried.Origins[n]);
    if (number >= 0 && band.Leaves.IsOwn(static_cast<std::size_t>(number)))
    {
      BandLeaf& leaf = band.Leaves[number];
      std::copy_n(carried.Values.Of(n), 512, leaf.Value);
      leaf.Inside = InsideNodes(leaf.Value);
      leaf.HoldsStaleValue = LeafMask::All();
    }
    if (number >= 0)
    {
      numbers.push_back(number);
    }
  }
  std::sort(numbers.begin(), numbers.end());
  TellNeighbours(band.Leaves, numbers,
    [&band](std::size_t i, auto& pass)
    {
      pass(band.Leaves[i].Value, 512);
      pass(&band.Leaves[i].Inside, 1);
    });
  return numbers;
}

/** The nodes that have a value are up to date, the others have only a side. */
void MarkUpdated(const FollowingBand& band, const CarriedValues& carried)
{
  for (const std::int32_t i : band.Set.Affected)
  {
    band.Leaves[i].Updated = band.Leaves[i].Active;
    band.Leaves.SummaryOf(i).Speed.IsKnown = false;
  }
  for (std::size_t n = 0; n < carried.Origins.size(); ++n)
  {
    const std::int32_t number = band.Leaves.Find(carried.Origins[n]);
    if (number >= 0)
    {
      band.Leaves[number].Updated = carried.Known[n];
    }
  }
}

/** Nodes beside the surface that have only a side, where displacements differ from node to node. */
void FillLayerZero(const FollowingBand& band)
{
  band.Leaves.ForEach(band.Set.Affected,
    [&band](std::size_t i)
    {
      BandLeaf& leaf = band.Leaves[i];
      leaf.UpToLayer[0].ForEach(
        [&leaf](int node)
        {
          if (!(std::fabs(leaf.Value[node]) < .5f * Far))
          {
            leaf.Value[node] = leaf.Inside.Has(node) ? -.5f : .5f;
          }
        });
    });
  TellNeighbours(band.Leaves, band.Set.Affected,
    [&band](std::size_t i, auto& pass) { pass(band.Leaves[i].Value, 512); });
}

/** No carried node is beyond walls or in the obstacle. */
void Confine(const FollowingBand& band, const Motion& motion)
{
  if (!motion.Box.Present && !motion.Solid)
  {
    return;
  }
  band.Buffers.MakeRoomForNodes(band.Leaves);
  band.Leaves.ForEach(band.Set.Active,
    [&band](std::size_t i) { std::copy_n(band.Leaves[i].Value, 512, band.Buffers.NextOf(i)); });
  ClampToBounds({ motion.Box, motion.Solid, band.VoxelSize }, band.Leaves, band.Set, band.Buffers);
  CommitStep(band.Leaves, band.Set, band.Buffers);
  RebuildLayers(band.Leaves, band.Set, band.Potential);
  FillGhostsAndEntered(band.Leaves, band.Set, band.Buffers.Nodes);
}

}

bool CarrySurface(const FollowingBand& band, const Motion& motion, double begin, double end,
  Target& target, AdvanceReport& report)
{
  const double factor = motion.Transport * (end - begin) / band.VoxelSize;
  const TargetDisplacements displacements(target, band.VoxelSize, factor);
  MakeValuesWhole(band.Leaves);
  target.MoveVelocitiesTo(begin);
  ForgetChanged(band.Leaves, band.VoxelSize, target);
  const CarriedLeaves leaves(band.Leaves, displacements);
  const std::size_t count = leaves.GetOrigins().size();
  report.MaxSpeed = std::max(report.MaxSpeed, leaves.GetLongest() * band.VoxelSize / (end - begin));
  target.MoveTo(end);
  ForgetChanged(band.Leaves, band.VoxelSize, target);
  if (count == 0)
  {
    return false;
  }
  MakeRoomFor(leaves.GetOrigins(), band.Leaves.GetRanks(), band.Buffers.StageFirst);
  CarriedValues carried{ leaves.GetOrigins(), band.Buffers.StageFirst, std::vector<LeafMask>(count),
    std::vector<char>(count) };
  const DisplacementLattice lattice(leaves.GetOrigins(), displacements, band.Leaves.GetRanks());
  const CarryLeaf carry(band.Leaves, band.Potential, leaves, lattice, carried);
  CarryLeaves(band.Leaves, carry, carried);
  band.Set.Choose(band.Leaves, TakeValues(band, carried));
  MarkUpdated(band, carried);
  RebuildLayers(band.Leaves, band.Set, band.Potential);
  FillLayerZero(band);
  FillGhostsAndEntered(band.Leaves, band.Set, band.Buffers.Nodes);
  Confine(band, motion);
  return true;
}

}
