/**
 * Which rank owns which part of space: boxes of leaves.
 */
#ifndef Domain_h
#define Domain_h

#include "ActiveNarrowBandExport.h"
#include "Agreement.h"
#include "NodeTarget.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

namespace activesurface
{

/** Cost of what is in a leaf. */
struct LeafCost
{
  NodeIndex Origin;
  double Cost;
};

/** The node below a place, relative to the node (0, 0, 0); at most 10^9 in size. */
inline NodeIndex NodeBelow(const double (&place)[3], double voxelSize)
{
  constexpr double farthest = 1e9; // as node numbers are 32-bit integers
  NodeIndex node;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double below = std::floor(place[axis] / voxelSize);
    node[axis] = static_cast<int>(std::min(std::max(below, -farthest), farthest));
  }
  return node;
}

/** The order of a tree's leaves, by nodes in them. */
bool IsBeforeInTree(const NodeIndex& a, const NodeIndex& b);

class ACTIVENARROWBAND_EXPORT Domain
{
public:
  /** Shares space out so that all ranks have about the same costs. own: the costs that this rank
   * knows, in any order. Collective: the same on all ranks. */
  static std::shared_ptr<const Domain> Share(const Agreement& ranks, std::vector<LeafCost> own);

  /** The rank that owns the leaf of a node. */
  int OwnerOf(const NodeIndex& node) const;
  bool IsOwn(const NodeIndex& node) const { return this->OwnerOf(node) == this->Ranks.GetRank(); }

  /** Replaces a list by the ranks that own leaves with nodes in a box, ascending. */
  void ListOwners(const NodeIndex& low, const NodeIndex& high, std::vector<int>& owners) const;

  /** Lists the other ranks that own leaves around one of this rank. */
  void ListOthersAround(const NodeIndex& leaf, std::vector<int>& others) const;

  /** A rank for each leaf, ascending in the order of the tree; they have about equally many. */
  int CounterOf(const NodeIndex& leaf) const;

  const Agreement& GetRanks() const { return this->Ranks; }

private:
  /** A plane between leaves: nodes with a smaller number along the axis are the lower ranks'. */
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
  std::vector<Cut> Cuts;         // of ranks [first, last) at their middle, and so on in halves
  std::vector<NodeIndex> Firsts; // in the order of the tree, of each counter but the first one
};

}

#endif
