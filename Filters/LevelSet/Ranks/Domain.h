/**
 * Partition of space among ranks: each rank owns the leaves in a box.
 */
#ifndef Domain_h
#define Domain_h

#include "ActiveLevelSetExport.h"
#include "Base/NodeTarget.h"
#include "Ranks/Agreement.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

namespace activesurface
{

/** Returns the first leaf of each rank, followed by the number of leaves. The cost of a rank
 * differs from the mean by at most the largest cost of a leaf. costsBefore: for each leaf the sum
 * of the costs of all earlier leaves, followed by the total cost. */
std::vector<std::size_t> ShareLeaves(const std::vector<std::size_t>& costsBefore, int ranks);

/** Cost of a leaf, in units of the cost of a particle. */
struct LeafCost
{
  NodeIndex Origin;
  double Cost;
};

/** Returns the node at or below a position [world units] along each axis; indices are clamped to
 * +-10^9. */
inline NodeIndex NodeBelow(const double (&place)[3], double voxelSize)
{
  constexpr double farthest = 1e9; // node coordinates are 32-bit integers
  NodeIndex node;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double below = std::floor(place[axis] / voxelSize);
    node[axis] = static_cast<int>(std::min(std::max(below, -farthest), farthest));
  }
  return node;
}

/** Returns true if the leaf of node a precedes the leaf of node b in the order of a tree. */
bool IsBeforeInTree(const NodeIndex& a, const NodeIndex& b);

class ACTIVELEVELSET_EXPORT Domain
{
public:
  /** Partitions space so that all ranks have about equal costs. own: the costs that this rank
   * knows, in any order. Collective; all ranks get the same partition. */
  static std::shared_ptr<const Domain> Share(const Agreement& ranks, std::vector<LeafCost> own);

  /** Returns the rank that owns the leaf of a node. */
  int OwnerOf(const NodeIndex& node) const;
  bool IsOwn(const NodeIndex& node) const { return this->OwnerOf(node) == this->Ranks.GetRank(); }

  /** Replaces `owners` by the ranks that own leaves with nodes in a box, ascending. */
  void ListOwners(const NodeIndex& low, const NodeIndex& high, std::vector<int>& owners) const;

  /** Replaces `others` by the other ranks that own the leaf or its neighbours, ascending. */
  void ListOthersAround(const NodeIndex& leaf, std::vector<int>& others) const;

  /** Returns the rank that counts the vertices of a leaf. Leaves later in the order of the tree
   * have the same or a higher rank. */
  int CounterOf(const NodeIndex& leaf) const;

  const Agreement& GetRanks() const { return this->Ranks; }

private:
  /** A plane between leaves: lower ranks own the nodes with smaller coordinates along the axis. */
  struct Cut
  {
    int Axis = 0;
    int Place = 1 << 30;
  };
  using CostIterator = std::vector<LeafCost>::iterator;

  explicit Domain(const Agreement& ranks)
    : Ranks(ranks)
    , Cuts(static_cast<std::size_t>(ranks.GetSize()))
  {
  }
  void Divide(CostIterator begin, CostIterator end, int first, int last);

  const Agreement Ranks;
  std::vector<Cut> Cuts;         // index: `middle` of Divide
  std::vector<NodeIndex> Firsts; // first leaf that each of the ranks 1, 2, ... counts
};

}

#endif
