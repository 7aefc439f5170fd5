#include "Implicit/Carry.h"

#include "Implicit/CarriedLeaves.h"
#include "Implicit/OldValues.h"
#include "Leaves/GhostFill.h"
#include "Leaves/Layers.h"
#include "Leaves/LeafKernels.h"
#include "Substep/ConvergedLeaves.h"
#include "Substep/StepForward.h"
#include "Substep/SubstepBuffers.h"
#include "Substep/WalledTarget.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace activesurface
{

namespace
{

/** The displacement at each node of a leaf, from 27 points. */
class LeafDisplacements
{
public:
  static constexpr int Points = TargetDisplacements::Most;

  LeafDisplacements(const openvdb::Coord& origin, const TargetDisplacements& displacements)
  {
    double points[3 * Points];
    for (int n = 0; n < Points; ++n)
    {
      const int at[3] = { n / 9, n / 3 % 3, n % 3 };
      for (int axis = 0; axis < 3; ++axis)
      {
        points[3 * n + axis] = origin[axis] + 4 * at[axis];
      }
    }
    displacements.Evaluate(Points, points, this->Values);
    for (int n = 0; n < Points; ++n)
    {
      const double* value = this->Values + 3 * n;
      this->IsKnown[n] = std::isfinite(value[0] + value[1] + value[2]);
    }
  }

  /** The mean of the known ones of the eight points around a node, weighted as in linear
   * interpolation; false if there are none. */
  bool Find(int node, double displacement[3]) const
  {
    const int at[3] = { node >> 6, (node >> 3) & 7, node & 7 };
    double sum[3] = { 0.0, 0.0, 0.0 }, weights = 0.0;
    for (int corner = 0; corner < 8; ++corner)
    {
      const int upper[3] = { corner >> 2, (corner >> 1) & 1, corner & 1 };
      double weight = 1.0;
      int point = 0;
      for (int axis = 0; axis < 3; ++axis)
      {
        const double t = .25 * (at[axis] & 3);
        weight *= upper[axis] ? t : 1.0 - t;
        point = 3 * point + (at[axis] >> 2) + upper[axis];
      }
      // A known point without weight is better than none.
      weight = this->IsKnown[point] ? std::max(weight, 1e-9) : 0.0;
      for (int axis = 0; axis < 3 && weight > 0.0; ++axis)
      {
        sum[axis] += weight * this->Values[3 * point + axis];
      }
      weights += weight;
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      displacement[axis] = weights > 0.0 ? sum[axis] / weights : 0.0;
    }
    return weights > 0.0;
  }

private:
  double Values[3 * Points];
  bool IsKnown[Points];
};

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
    const TargetDisplacements& displacements, CarriedValues& result)
    : Table(table)
    , Tree(tree)
    , Carried(carried)
    , Displacements(displacements)
    , Result(result)
  {
  }

  void operator()(std::size_t n) const
  {
    const openvdb::Coord origin = this->Result.Origins[n];
    const std::int32_t number = this->Table.Find(origin);
    const LeafDisplacements ways(origin, this->Displacements);
    double feet[3 * 512];
    LeafMask left;
    for (int node = 0; node < 512; ++node)
    {
      double way[3];
      const bool isKnown = ways.Find(node, way);
      if (!isKnown && number >= 0 && this->Carried.HasLeft(number, node))
      {
        left.Add(node);
      }
      const int at[3] = { node >> 6, (node >> 3) & 7, node & 7 };
      for (int axis = 0; axis < 3; ++axis)
      {
        feet[3 * node + axis] = origin[axis] + at[axis] - way[axis];
      }
    }
    this->Interpolate(n, origin, feet, left);
  }

private:
  void Interpolate(
    std::size_t n, const openvdb::Coord& origin, const double* feet, const LeafMask& left) const
  {
    const OldValues old(this->Table, this->Tree, feet);
    float* values = this->Result.Values.Of(n);
    LeafMask known;
    for (int node = 0; node < 512; ++node)
    {
      const float value = left.Has(node) ? Far : old.Interpolate(feet + 3 * node);
      if (std::fabs(value) < .5f * Far)
      {
        known.Add(node);
      }
      values[node] = value;
    }
    this->Result.Known[n] = known;
    const float before = this->Tree.getValue(origin);
    this->Result.Differs[n] = known.Any() ||
      std::any_of(values, values + 512, [before](float v) { return (v < 0.f) != (before < 0.f); });
  }

  const LeafTable& Table;
  const PotentialTree& Tree;
  const CarriedLeaves& Carried;
  const TargetDisplacements& Displacements;
  CarriedValues& Result;
};

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
  band.Leaves.Add(wanted, band.Potential);
  LeafList numbers;
  for (std::size_t n = 0; n < carried.Origins.size(); ++n)
  {
    const std::int32_t number = band.Leaves.Find(carried.Origins[n]);
    if (number >= 0)
    {
      BandLeaf& leaf = band.Leaves[number];
      std::copy_n(carried.Values.Of(n), 512, leaf.Value);
      leaf.Inside = InsideNodes(leaf.Value);
      leaf.HoldsStaleValue = LeafMask::All();
      numbers.push_back(number);
    }
  }
  std::sort(numbers.begin(), numbers.end());
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
}

/** No carried node is beyond walls or in the obstacle. */
void Confine(const FollowingBand& band, const Motion& motion)
{
  if (!motion.Box.Present && !motion.Solid)
  {
    return;
  }
  band.Buffers.MakeRoomForNodes(band.Leaves.Size());
  band.Leaves.ForEach(band.Set.Active,
    [&band](std::size_t i) { std::copy_n(band.Leaves[i].Value, 512, band.Buffers.NextOf(i)); });
  ClampToBounds({ motion.Box, motion.Solid, band.VoxelSize }, band.Leaves, band.Set, band.Buffers);
  CommitStep(band.Leaves, band.Set, band.Buffers);
  RebuildLayers(band.Leaves, band.Set, band.Potential);
  FillGhostsAndEntered(band.Leaves, band.Set, band.Buffers.Nodes);
}

void ForEachOrigin(
  const FollowingBand& band, const CarriedValues& carried, bool isParallel, const CarryLeaf& carry)
{
  LeafList places(carried.Origins.size());
  std::iota(places.begin(), places.end(), 0);
  if (isParallel)
  {
    band.Leaves.ForEach(places, carry);
  }
  else
  {
    std::for_each(places.begin(), places.end(), carry);
  }
}

}

bool CarrySurface(const FollowingBand& band, const Motion& motion, double begin, double end,
  Target& target, AdvanceReport& report)
{
  const double factor = motion.Transport * (end - begin) / band.VoxelSize;
  const TargetDisplacements displacements(target, band.VoxelSize, factor);
  target.MoveTo(begin);
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
  band.Buffers.StageFirst.MakeRoom(count);
  CarriedValues carried{ leaves.GetOrigins(), band.Buffers.StageFirst, std::vector<LeafMask>(count),
    std::vector<char>(count) };
  ForEachOrigin(band, carried, target.IsThreadSafe(),
    CarryLeaf(band.Leaves, band.Potential, leaves, displacements, carried));
  band.Set.Choose(band.Leaves, TakeValues(band, carried));
  MarkUpdated(band, carried);
  RebuildLayers(band.Leaves, band.Set, band.Potential);
  FillLayerZero(band);
  FillGhostsAndEntered(band.Leaves, band.Set, band.Buffers.Nodes);
  Confine(band, motion);
  return true;
}

}
