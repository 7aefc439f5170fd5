#include "Start/PartBand.h"

#include "Leaves/EikonalUpdate.h"
#include "Leaves/Layers.h"
#include "Leaves/LeafTable.h"
#include "Start/LatticeFunction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace activesurface
{

namespace
{

/**
 * Distances in the layers of a band, from its signs and a function.
 *
 * A distance is |F| / |grad F|, by central differences: second-order accurate if F is a distance,
 * and smooth where F is smooth. This distance is limited to 0.5 to 1.5 times another estimate:
 * distances to the crossings on edges, extended from node to node by eikonal updates
 * (EikonalUpdate.h). A sweep uses only nodes of earlier sweeps, so the order within a sweep does
 * not matter.
 */
class PartDistances
{
public:
  explicit PartDistances(LeafTable& table);

  /**
   * Sets the values of all nodes in the layers, from the magnitudes of the function and the signs
   * of the table.
   */
  void Find(const LatticeFunction& function);

private:
  void SampleAll(const LatticeFunction& function);
  void Sample(const LatticeFunction& function, std::size_t i);
  void StartAtCrossings(std::size_t i);
  float DistanceToCrossings(std::size_t i, int node) const;
  /** Runs one sweep. Returns false if the sweep has reached no further node of the layers. */
  bool Extend();
  bool ExtendLeaf(std::size_t i);
  LeafMask FindFront(std::size_t i) const;
  float SolveEikonal(std::size_t i, int node) const;
  void UseFunction(std::size_t i);
  float FirstOrderDistance(std::size_t i, int node) const;

  bool IsKnown(const LeafTable::Place& place) const
  {
    return place.Leaf >= 0 && this->Known[place.Leaf].Has(place.Node);
  }
  float MagnitudeAt(const LeafTable::Place& place) const;

  LeafTable& Table;
  std::vector<std::unique_ptr<double[]>> Function; // F in the layers, with the signs of the table
  std::vector<LeafMask> Known;
  std::vector<LeafMask> NextKnown;
};

PartDistances::PartDistances(LeafTable& table)
  : Table(table)
  , Function(table.Size())
  , Known(table.Size())
  , NextKnown(table.Size())
{
}

void PartDistances::Find(const LatticeFunction& function)
{
  this->SampleAll(function);
  this->Table.ForEach([&](std::size_t i) { this->StartAtCrossings(i); });
  while (this->Extend())
  {
  }
  this->Table.ForEach([&](std::size_t i) { this->UseFunction(i); });
}

void PartDistances::SampleAll(const LatticeFunction& function)
{
  for (std::size_t i = 0; i < this->Table.Size(); ++i)
  {
    if (this->Table[i].UpToLayer[LastLayer].Any())
    {
      this->Function[i].reset(new double[512]);
    }
  }
  function.ForEach(0, this->Table.Size(), [&](std::size_t i) { this->Sample(function, i); });
}

void PartDistances::Sample(const LatticeFunction& function, std::size_t i)
{
  constexpr double most = 1e300; // keeps differences finite
  const BandLeaf& leaf = this->Table[i];
  const LeafMask& nodes = leaf.UpToLayer[LastLayer];
  if (!nodes.Any())
  {
    return;
  }
  double* values = this->Function[i].get();
  function.Evaluate(leaf.Origin, nodes, values);
  nodes.ForEach(
    [&](int node)
    {
      const double magnitude = std::fabs(values[node]);
      const double finite = magnitude <= most ? magnitude : most; // includes NaN
      values[node] = leaf.Inside.Has(node) ? -finite : finite;
    });
}

void PartDistances::StartAtCrossings(std::size_t i)
{
  BandLeaf& leaf = this->Table[i];
  this->Known[i] = NodesWithCrossing(this->Table, leaf);
  this->Known[i].ForEach([&](int node) { leaf.Value[node] = this->DistanceToCrossings(i, node); });
}

/** Distance [voxels] from a node to the plane through the nearest crossing on each axis, for F
 * linear between nodes. */
float PartDistances::DistanceToCrossings(std::size_t i, int node) const
{
  const BandLeaf& leaf = this->Table[i];
  const double here = std::fabs(this->Function[i][node]);
  double squares = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    double nearest = 0.0; // 1 / distance
    for (const int sign : { -1, 1 })
    {
      const LeafTable::Place next =
        this->Table.Step(static_cast<std::int32_t>(i), node, axis, sign);
      if (next.Leaf < 0 || this->Table[next.Leaf].Inside.Has(next.Node) == leaf.Inside.Has(node))
      {
        continue;
      }
      if (!(here > 0.0))
      {
        return 0.f;
      }
      const double there = std::fabs(this->Function[next.Leaf][next.Node]);
      nearest = std::max(nearest, 1.0 + there / here);
    }
    squares += nearest * nearest;
  }
  return static_cast<float>(1.0 / std::sqrt(squares));
}

bool PartDistances::Extend()
{
  std::vector<char> grows(this->Table.Size());
  this->Table.ForEach([&](std::size_t i) { grows[i] = this->ExtendLeaf(i); });
  std::swap(this->Known, this->NextKnown);
  return std::find(grows.begin(), grows.end(), 1) != grows.end();
}

bool PartDistances::ExtendLeaf(std::size_t i)
{
  const LeafMask front = this->FindFront(i);
  front.ForEach([&](int node) { this->Table[i].Value[node] = this->SolveEikonal(i, node); });
  this->NextKnown[i] = this->Known[i] | front;
  return front.Any();
}

/** Returns the unknown nodes of the layers that have a known neighbour. */
LeafMask PartDistances::FindFront(std::size_t i) const
{
  static const LeafMask nothing;
  const BandLeaf& leaf = this->Table[i];
  LeafMask around;
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::int32_t next = leaf.Neighbour[FaceNumber(axis, 1)];
    const std::int32_t previous = leaf.Neighbour[FaceNumber(axis, -1)];
    around = around | SeenAhead(this->Known[i], next >= 0 ? this->Known[next] : nothing, axis, 1) |
      SeenBehind(this->Known[i], previous >= 0 ? this->Known[previous] : nothing, axis, 1);
  }
  return (around & leaf.UpToLayer[LastLayer]).Without(this->Known[i]);
}

float PartDistances::MagnitudeAt(const LeafTable::Place& place) const
{
  return this->Table[place.Leaf].Value[place.Node];
}

float PartDistances::SolveEikonal(std::size_t i, int node) const
{
  const auto number = static_cast<std::int32_t>(i);
  const bool isInside = this->Table[i].Inside.Has(node);
  std::array<UpwindTerm, 3> terms;
  int count = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    UpwindTerm best = { HUGE_VAL, 0.0 };
    double nearest = HUGE_VAL;
    for (const int sign : { -1, 1 })
    {
      const LeafTable::Place first = this->Table.Step(number, node, axis, sign);
      if (!this->IsKnown(first) || !(this->MagnitudeAt(first) < nearest))
      {
        continue;
      }
      const double a1 = nearest = this->MagnitudeAt(first);
      best = FirstOrderTerm(a1);
      const LeafTable::Place second = this->Table.Step(number, node, axis, 2 * sign);
      if (this->IsKnown(second))
      {
        const double magnitude = this->MagnitudeAt(second);
        const bool isBeyond = this->Table[second.Leaf].Inside.Has(second.Node) != isInside;
        const double a2 = isBeyond ? -magnitude : magnitude;
        best = SecondOrderTerm(a1, a2);
      }
    }
    if (best.Weight > 0.0)
    {
      terms[count++] = best;
    }
  }
  return static_cast<float>(activesurface::SolveEikonal(terms, count));
}

void PartDistances::UseFunction(std::size_t i)
{
  BandLeaf& leaf = this->Table[i];
  constexpr float leastInside = 1e-30f; // keeps the sign
  leaf.UpToLayer[LastLayer].ForEach(
    [&](int node)
    {
      const float known = leaf.Value[node];
      const float smooth = this->FirstOrderDistance(i, node);
      const float distance =
        smooth < 0.f ? known : std::min(std::max(smooth, .5f * known), 1.5f * known);
      leaf.Value[node] = leaf.Inside.Has(node) ? -std::max(distance, leastInside) : distance;
    });
}

/** Returns |F| / |grad F|, or -1 if a neighbour is missing or F is flat. */
float PartDistances::FirstOrderDistance(std::size_t i, int node) const
{
  double difference[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    double value[2];
    for (const int side : { 0, 1 })
    {
      const LeafTable::Place place =
        this->Table.Step(static_cast<std::int32_t>(i), node, axis, 2 * side - 1);
      if (place.Leaf < 0 || !this->Table[place.Leaf].UpToLayer[LastLayer].Has(place.Node))
      {
        return -1.f;
      }
      value[side] = this->Function[place.Leaf][place.Node];
    }
    difference[axis] = .5 * (value[1] - value[0]);
  }
  const double slope = std::hypot(difference[0], difference[1], difference[2]);
  return slope > 0.0 ? static_cast<float>(std::fabs(this->Function[i][node]) / slope) : -1.f;
}

/** Returns true if an inside leaf is next to an outside leaf. The inside leaf must then not become
 * a tile, as no other leaf contains the surface between the two. */
bool IsNextToOutside(const LeafSigns& inside, std::size_t i)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const int sign : { -1, 1 })
    {
      const std::int32_t next = inside.FindNext(i, axis, sign);
      if (next == LeafSigns::None || !inside[next].Nodes.Any())
      {
        return true;
      }
    }
  }
  return false;
}

}

PartBand::PartBand(const LeafSigns& inside)
  : Tree(std::make_shared<openvdb::FloatTree>(Far))
{
  for (std::size_t i = 0; i < inside.Size(); ++i)
  {
    this->AddLeaf(inside, i);
  }
  this->Leaves.SetBackground(Far);
  this->Leaves.Rebuild(*this->Tree);
  ActiveSet set;
  set.ChooseAll(this->Leaves);
  RebuildLayers(this->Leaves, set, *this->Tree);
}

void PartBand::AddLeaf(const LeafSigns& inside, std::size_t i)
{
  const LeafSigns::Leaf& leaf = inside[i];
  if (!leaf.Nodes.Any())
  {
    return;
  }
  if (leaf.Nodes == LeafMask::All() && !IsNextToOutside(inside, i))
  {
    this->Tree->addTile(1, leaf.Origin, -Far, false);
    return;
  }
  float* values = this->Tree->touchLeaf(leaf.Origin)->buffer().data();
  for (int node = 0; node < 512; ++node)
  {
    values[node] = leaf.Nodes.Has(node) ? -Far : Far;
  }
}

std::size_t PartBand::CountActive() const
{
  return this->Leaves.Count([](const LeafSummary& leaf) { return leaf.ActiveNodes; });
}

void PartBand::FindDistances(const LatticeFunction& function)
{
  PartDistances(this->Leaves).Find(function);
}

}
