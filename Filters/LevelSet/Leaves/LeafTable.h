/**
 * The leaves of the potential, each with its masks and its 26 neighbours. Leaves are in the order
 * of the tree, except leaves added since Rebuild, which come last.
 *
 * The table has data derived from the potential: layers, active nodes, crossed edges. Passes over
 * the band call a kernel for each leaf, mostly in parallel. A parallel kernel writes only the leaf
 * for which it is called.
 */
#ifndef LeafTable_h
#define LeafTable_h

#include "Base/OpenVDB.h"
#include "Leaves/LeafMask.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <array>
#include <cstdint>
#include <vector>

namespace activesurface
{

using PotentialTree = openvdb::FloatTree;
using PotentialLeaf = PotentialTree::LeafNodeType;

/** Number of a missing neighbour: all its nodes are on one side of the surface. */
constexpr std::int32_t NoLeafOutside = -1;
constexpr std::int32_t NoLeafInside = -2;

/** Magnitude of u beyond the layers [voxels]; only the sign of this u has a meaning. The paper's
 * scheme has PaperThreshold instead. */
constexpr float Far = 1000.f;

/** Numbers of leaves. The lists of a LeafTable and of an ActiveSet are ascending, except the result
 * of FindTreeOrder. */
using LeafList = std::vector<std::int32_t>;

constexpr int NumberOfLayers = 5; // 0..2 band, 3 and 4 ghosts
constexpr int LastBandLayer = 2;
constexpr int LastLayer = NumberOfLayers - 1;

/** Number of a neighbour; offsets in {-1,0,1}. 13 is the leaf itself. */
constexpr int NeighbourNumber(int dx, int dy, int dz)
{
  return 9 * (dx + 1) + 3 * (dy + 1) + dz + 1;
}

/** Number of the neighbour across a face. axis 0..2, sign -1 or 1. */
constexpr int FaceNumber(int axis, int sign)
{
  return 13 + sign * (axis == 0 ? 9 : axis == 1 ? 3 : 1);
}

/** Distance in a leaf's array from a node to the next node along an axis. */
constexpr int Stride(int axis)
{
  return axis == 0 ? 64 : axis == 1 ? 8 : 1;
}

/** The speed in a leaf [length/time], valid until the leaf or a neighbour is updated, or the target
 * changes near the leaf. */
struct LeafSpeed
{
  bool IsKnown = false;
  float AtNodes = 0.f;      //< largest |target speed| at the nodes with samples
  float AtSurface = 0.f;    //< speed of the surface, see ConvergedLeaves.h
  double TargetSlope = 0.0; //< largest |dF/dn|
};

/** Data that every substep reads of all leaves, including converged leaves; small, to reduce the
 * cost. */
struct LeafSummary
{
  LeafSpeed Speed;
  std::int32_t ActiveNodes = 0;
  std::int32_t ZeroNodes = 0; //< nodes of layer 0
  std::int32_t Crossings = 0;
  bool IsUsed = false;    //< true if a node is in a layer or active
  bool IsForeign = false; //< true if another rank owns the leaf
};

struct BandLeaf
{
  BandLeaf() = default;
  explicit BandLeaf(PotentialLeaf& leaf);

  /** Origin of a neighbour, by its number. */
  openvdb::Coord OriginOf(int n) const
  {
    return this->Origin.offsetBy(8 * (n / 9 - 1), 8 * (n / 3 % 3 - 1), 8 * (n % 3 - 1));
  }

  float* Value = nullptr; //< the leaf's own 512 values of u
  PotentialLeaf* Leaf = nullptr;
  openvdb::Coord Origin;
  std::array<std::int32_t, 27> Neighbour{};
  std::uint32_t MissingNeighbours = 0; //< reached by a layer, but without a leaf; one bit each

  LeafMask Inside;                                //< u < 0
  std::array<LeafMask, NumberOfLayers> UpToLayer; //< nodes of the layers 0..m
  LeafMask Active;                                //< band and pockets: updated by the next substep
  LeafMask Updated;                               //< nodes whose value the last substep has updated
  LeafMask HoldsStaleValue = LeafMask::All(); //< nodes whose value may differ from the background
  std::array<LeafMask, 3> Edge;               //< crossed edges, by axis, at their lower node
  std::size_t FirstCrossing = 0;              //< number of the first crossed edge
  std::array<int, 3> CrossingsBefore{};       //< crossed edges of this leaf on earlier axes
  int Crossings = 0;                          //< crossed edges of this leaf
};

class Domain;

/** Returns the mask of the negative values among the 512 values of a leaf. */
LeafMask InsideNodes(const float* values);

class LeafTable
{
public:
  /** Sets the owners of the leaves; null: this rank owns all. Call before Rebuild. */
  void SetDomain(const Domain* domain) { this->Space = domain; }

  /** Reads the leaves of the tree; keeps the data of leaves that were in the table. */
  void Rebuild(PotentialTree& tree);

  /** Adds missing leaves to the tree and the table; the numbers of other leaves do not change.
   * Returns the numbers of the new leaves, ascending. */
  LeafList Add(const std::vector<openvdb::Coord>& origins, PotentialTree& tree);

  ///@{
  /** IsSorted returns true if all leaves are in the order of the tree; FindTreeOrder returns their
   * numbers in that order. */
  bool IsSorted() const { return this->Sorted == this->Leaves.size(); }
  LeafList FindTreeOrder() const;
  ///@}

  /** Returns these leaves and their neighbours. */
  LeafList FindAround(const LeafList& leaves) const;

  /** Returns all leaves for which condition(i) is true. */
  template <class Condition>
  LeafList FindAll(Condition&& condition) const
  {
    LeafList found;
    for (std::size_t i = 0; i < this->Leaves.size(); ++i)
    {
      if (condition(i))
      {
        found.push_back(static_cast<std::int32_t>(i));
      }
    }
    return found;
  }

  std::size_t Size() const { return this->Leaves.size(); }
  BandLeaf& operator[](std::size_t i) { return this->Leaves[i]; }
  const BandLeaf& operator[](std::size_t i) const { return this->Leaves[i]; }

  LeafSummary& SummaryOf(std::size_t i) { return this->Summaries[i]; }
  const LeafSummary& SummaryOf(std::size_t i) const { return this->Summaries[i]; }
  /** Updates the summary of a leaf whose nodes have changed, except Speed and IsForeign. */
  ACTIVE_ALWAYS_INLINE void Summarise(std::size_t i);

  ///@{
  /** Returns the mask of a neighbour. If the neighbour has no leaf, the mask is empty, except that
   * InsideOf returns a full mask for a neighbour inside the surface. */
  const LeafMask& UpToLayerOf(std::int32_t number, int layer) const
  {
    return number >= 0 ? this->Leaves[number].UpToLayer[layer] : this->Nothing;
  }
  const LeafMask& InsideOf(std::int32_t number) const
  {
    return number >= 0         ? this->Leaves[number].Inside
      : number == NoLeafInside ? this->Everything
                               : this->Nothing;
  }
  ///@}

  /** Leaf and number of a node; Leaf is negative if the node has no leaf. Step returns the node
   * `steps` nodes away along an axis; |steps| is at most 8. */
  struct Place
  {
    std::int32_t Leaf;
    int Node;
  };
  Place Step(std::int32_t leaf, int node, int axis, int steps) const
  {
    const int stride = Stride(axis);
    const int side = (((node / stride) & 7) + steps) >> 3;
    const int moved = node + (steps - 8 * side) * stride;
    return { side == 0 ? leaf : this->Leaves[leaf].Neighbour[FaceNumber(axis, side)], moved };
  }

  /** Like Step, for an offset of at most 8 nodes along each axis. */
  Place Offset(std::int32_t leaf, int node, int dx, int dy, int dz) const;

  /** Calls function(i) for every leaf, or for the leaves of a list, in parallel. */
  template <class Function>
  void ForEach(Function&& function) const
  {
    ForRange(this->Leaves.size(), function);
  }

  template <class Function>
  void ForEach(const LeafList& leaves, Function&& function) const
  {
    ForRange(
      leaves.size(), [&](std::size_t place) { function(static_cast<std::size_t>(leaves[place])); });
  }

  /** Returns the sum of function(summary), an integer, over this rank's leaves. */
  template <class Function>
  std::size_t Count(Function&& function) const
  {
    std::size_t count = 0;
    for (const LeafSummary& summary : this->Summaries)
    {
      count += summary.IsForeign ? 0 : static_cast<std::size_t>(function(summary));
    }
    return count;
  }

  /** Sets the value of nodes beyond the layers: `value` outside the surface, -value inside. */
  void SetBackground(float value)
  {
    this->Background[0].fill(value);
    this->Background[1].fill(-value);
  }
  float GetBackground() const { return this->Background[0][0]; }
  float BackgroundOf(std::int32_t number) const { return *this->BackgroundRowOf(number); }
  /** Eight copies of BackgroundOf. */
  const float* BackgroundRowOf(std::int32_t number) const
  {
    return this->Background[number == NoLeafInside ? 1 : 0].data();
  }

  /** Returns the number of a leaf by its origin, or a negative number. */
  std::int32_t Find(const openvdb::Coord& origin) const;

private:
  static constexpr std::size_t Grain = 16; //< leaves: some microseconds of work

  template <class Function>
  static void ForRange(std::size_t size, Function&& function)
  {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, size, Grain),
      [&](const tbb::blocked_range<std::size_t>& range)
      {
        for (std::size_t i = range.begin(); i != range.end(); ++i)
        {
          function(i);
        }
      });
  }

  void FindNeighbours(std::size_t i, const PotentialTree& tree);
  bool IsForeign(const openvdb::Coord& origin) const;
  void BuildIndex();
  void AddToIndex(std::size_t i);

  std::vector<BandLeaf> Leaves;
  std::vector<LeafSummary> Summaries; // of each leaf
  std::size_t Sorted = 0;             // number of leaves at Rebuild
  std::vector<std::int32_t> Index;    // open-addressing hash of the origins
  std::array<std::array<float, 8>, 2> Background{};
  const Domain* Space = nullptr;
  LeafMask Nothing;
  LeafMask Everything = LeafMask::All();
};

/** Returns true if the leaf at origin a precedes the leaf at b in the order of a tree. */
bool IsBeforeInTree(const openvdb::Coord& a, const openvdb::Coord& b);

ACTIVE_ALWAYS_INLINE void LeafTable::Summarise(std::size_t i)
{
  const BandLeaf& leaf = this->Leaves[i];
  LeafSummary& summary = this->Summaries[i];
  summary.ActiveNodes = leaf.Active.Count();
  summary.ZeroNodes = leaf.UpToLayer[0].Count();
  summary.Crossings = leaf.Crossings;
  summary.IsUsed = leaf.UpToLayer[LastLayer].Any() || leaf.Active.Any();
}

/** Returns the nodes at either end of a crossed edge. */
LeafMask NodesWithCrossing(const LeafTable& table, const BandLeaf& leaf);

}

#endif
