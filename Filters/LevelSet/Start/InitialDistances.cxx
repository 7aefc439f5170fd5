#include "Start/InitialDistances.h"

#include "Base/OpenVDB.h"
#include "Leaves/CentralGradient.h"
#include "Leaves/LeafTable.h"

#include <openvdb/tools/FastSweeping.h>
#include <openvdb/tools/Morphology.h>
#include <openvdb/tools/SignedFloodFill.h>
#include <openvdb/tree/LeafManager.h>

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <vector>

namespace activesurface
{

namespace
{

using Leaves = openvdb::tree::LeafManager<openvdb::FloatTree>;

/** Evaluates the function at the active nodes of a leaf, times a scale. */
void SampleNodes(const NodeFunction& function, double scale, PotentialLeaf& leaf)
{
  constexpr double most = 1e6; // far from the surface a function may have any values
  std::vector<openvdb::Coord> nodes;
  for (auto it = leaf.cbeginValueOn(); it; ++it)
  {
    nodes.push_back(it.getCoord());
  }
  std::vector<double> values;
  function.Evaluate(nodes, values);
  auto value = values.begin();
  for (auto it = leaf.beginValueOn(); it; ++it, ++value)
  {
    const double scaled = std::min(std::max(scale * *value, -most), most);
    // A negative value that rounds to zero keeps its sign.
    const float stored = static_cast<float>(scaled);
    it.setValue(scaled < 0.0 ? std::min(stored, -1e-30f) : stored);
  }
}

template <class Function>
void ForEach(std::size_t count, bool isParallel, Function&& function)
{
  if (isParallel)
  {
    tbb::parallel_for(std::size_t{ 0 }, count, function);
    return;
  }
  for (std::size_t n = 0; n < count; ++n)
  {
    function(n);
  }
}

/** Samples the function near the crossed nodes, scaled so that the largest |value| at these nodes
 * is 1 to 2. */
openvdb::FloatTree::Ptr SampleNearby(CrossedNodes& crossed, const NodeFunction& function)
{
  // One layer of nodes beyond the band's layers, for central differences in every layer.
  openvdb::tools::dilateActiveValues(
    crossed.Nodes, NumberOfLayers, openvdb::tools::NN_FACE, openvdb::tools::IGNORE_TILES);
  auto tree = std::make_shared<openvdb::FloatTree>(crossed.Nodes, Far, openvdb::TopologyCopy());
  crossed.Nodes.clear();
  const double scale = crossed.Largest > 0.0 ? std::ldexp(1.0, -std::ilogb(crossed.Largest)) : 1.0;
  Leaves leaves(*tree);
  const auto sample = [&](std::size_t n) { SampleNodes(function, scale, leaves.leaf(n)); };
  ForEach(leaves.leafCount(), function.ThreadSafe, sample);
  return tree;
}

/** Returns |F| / |grad F| by central differences; -1 if a neighbour is missing or F is flat. */
float FirstOrderDistance(const openvdb::tree::ValueAccessor<const openvdb::FloatTree>& function,
  const openvdb::Coord& node)
{
  bool isKnown = true;
  const double square = CentralGradientSquare<double>(node,
    [&](const openvdb::Coord& next)
    {
      isKnown = isKnown && function.isValueOn(next);
      return function.getValue(next);
    });
  return isKnown && square > 0.0
    ? static_cast<float>(std::fabs(function.getValue(node)) / std::sqrt(square))
    : -1.f;
}

/** Replaces the distances from fast sweeping at the active nodes of `potential`. The new values are
 * the function's first-order distances, which are smoother, clamped to 0.5 to 1.5 times the swept
 * distances. Where F is flat or a neighbour is missing, the swept distances stay. */
void SmoothDistances(const openvdb::FloatTree& function, openvdb::FloatTree& potential)
{
  Leaves leaves(potential);
  leaves.foreach (
    [&](PotentialLeaf& leaf, std::size_t)
    {
      openvdb::tree::ValueAccessor<const openvdb::FloatTree> accessor(function);
      for (auto it = leaf.beginValueOn(); it; ++it)
      {
        const float swept = std::fabs(*it);
        float distance = FirstOrderDistance(accessor, it.getCoord());
        distance = distance < 0.f ? swept : std::min(std::max(distance, .5f * swept), 1.5f * swept);
        it.setValue(accessor.getValue(it.getCoord()) < 0.f ? -distance : distance);
      }
    });
}

/** Returns true if a node has a value below -1e-8 * largest. largest: largest value of the
 * function. Fast sweeping may treat magnitudes below 1e-8 as zero, and rejects a function without
 * negative values. */
bool HasInside(const openvdb::FloatTree& function, float largest)
{
  constexpr float zero = 1e-8f;
  for (auto it = function.cbeginValueOn(); it; ++it)
  {
    if (*it < -zero * largest)
    {
      return true;
    }
  }
  return false;
}

float LargestOf(const openvdb::FloatTree& function)
{
  float largest = 0.f;
  for (auto it = function.cbeginValueOn(); it; ++it)
  {
    largest = std::max(largest, *it);
  }
  return largest;
}

/** Planes of leaves Begin..End - 1 along x. */
struct Slab
{
  int Begin;
  int End;

  bool Has(const PotentialLeaf& leaf, int margin = 0) const
  {
    const int x = leaf.origin()[0] >> 3;
    return x >= this->Begin - margin && x < this->End + margin;
  }
};

/** Returns slabs of at least 1000 leaves; the last slab may be smaller. */
std::vector<Slab> FindSlabs(const openvdb::FloatTree& tree)
{
  constexpr int fewestLeaves = 1000;
  constexpr int fewestPlanes = 6; // margins add four planes
  std::map<int, int> planes;      // leaves in each
  for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf)
  {
    ++planes[leaf->origin()[0] >> 3];
  }
  std::vector<Slab> slabs;
  int leaves = 0;
  for (const auto& [plane, count] : planes)
  {
    if (slabs.empty() || (leaves >= fewestLeaves && plane - slabs.back().Begin >= fewestPlanes))
    {
      slabs.push_back({ plane, plane });
      leaves = 0;
    }
    slabs.back().End = plane + 1;
    leaves += count;
  }
  return slabs;
}

/** A slab and its margins in a separate tree, shifted so that few internal nodes of the tree
 * contain the slab. */
class SweptSlab
{
public:
  /** Planes of leaves around a slab. The surface may be cut off at the faces of the margin. The
   * resulting error of distances does not extend to the slab. */
  static constexpr int Margin = 2;

  SweptSlab(const openvdb::FloatTree& function, const Slab& slab)
    : Range(slab)
    , Shift(FindShift(function, slab))
    , Function(openvdb::FloatGrid::create(Far))
  {
    for (auto leaf = function.cbeginLeaf(); leaf; ++leaf)
    {
      if (slab.Has(*leaf, Margin))
      {
        auto copy = new PotentialLeaf(*leaf); // owned by the tree
        copy->setOrigin(leaf->origin() - this->Shift);
        this->Function->tree().addLeaf(copy);
      }
    }
  }

  void Sweep()
  {
    openvdb::FloatTree& function = this->Function->tree();
    openvdb::tools::signedFloodFillWithValues(function, Far, -Far);
    // Without a node clearly inside, the function's own values replace the swept distances.
    this->Distances = HasInside(function, LargestOf(function))
      ? openvdb::tools::sdfToSdf(*this->Function, 0.f, 1)
      : this->Function->deepCopy();
    SmoothDistances(function, this->Distances->tree());
    this->Function.reset();
  }

  /** Replaces the active values of the slab by distances. */
  void Write(openvdb::FloatTree& tree) const
  {
    for (auto leaf = tree.beginLeaf(); leaf; ++leaf)
    {
      if (this->Range.Has(*leaf))
      {
        const PotentialLeaf* from =
          this->Distances->tree().probeConstLeaf(leaf->origin() - this->Shift);
        for (auto it = leaf->beginValueOn(); it; ++it)
        {
          it.setValue(from->getValue(it.pos()));
        }
      }
    }
  }

private:
  static openvdb::Coord FindShift(const openvdb::FloatTree& function, const Slab& slab)
  {
    openvdb::Coord lowest = openvdb::Coord::max();
    for (auto leaf = function.cbeginLeaf(); leaf; ++leaf)
    {
      if (slab.Has(*leaf, Margin))
      {
        lowest.minComponent(leaf->origin());
      }
    }
    return lowest;
  }

  Slab Range;
  openvdb::Coord Shift;
  openvdb::FloatGrid::Ptr Function;
  openvdb::FloatGrid::Ptr Distances;
};

}

openvdb::FloatTree::Ptr MakeNearbyDistances(CrossedNodes& crossed, const NodeFunction& function)
{
  openvdb::FloatTree::Ptr tree = SampleNearby(crossed, function);
  if (!HasInside(*tree, 1.f))
  {
    return nullptr;
  }
  openvdb::tools::signedFloodFillWithValues(*tree, Far, -Far);
  // Distances replace the function of a slab only after the next slab has copied the function in
  // its own margin.
  std::unique_ptr<SweptSlab> before;
  for (const Slab& slab : FindSlabs(*tree))
  {
    auto next = std::make_unique<SweptSlab>(*tree, slab);
    if (before)
    {
      before->Write(*tree);
      before.reset();
    }
    next->Sweep();
    before = std::move(next);
  }
  before->Write(*tree);
  return tree;
}

}
