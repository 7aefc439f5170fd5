/**
 * Which rank owns which part of space: ranges of leaves in the order of the tree.
 */
#ifndef Domain_h
#define Domain_h

#include "ActiveNarrowBandExport.h"
#include "Agreement.h"
#include "NodeTarget.h"

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

class ACTIVENARROWBAND_EXPORT Domain
{
public:
  /** firsts: the first leaf of each rank but the first one, ascending in the order of the tree. */
  Domain(const Agreement& ranks, std::vector<NodeIndex> firsts);

  /** Shares space out so that all ranks have about the same costs. own: the costs that this rank
   * knows, in any order. Collective: the same on all ranks. */
  static std::shared_ptr<const Domain> Share(const Agreement& ranks, std::vector<LeafCost> own);

  /** The rank that owns the leaf of a node. */
  int OwnerOf(const NodeIndex& node) const;
  bool IsOwn(const NodeIndex& node) const { return this->OwnerOf(node) == this->Ranks.GetRank(); }

  /** Adds the ranks that own leaves with nodes in a box to those listed, each of them once. */
  void ListOwners(const NodeIndex& low, const NodeIndex& high, std::vector<int>& owners) const;

  /** Its rounds are those of all ranks. */
  Agreement& GetRanks() const { return this->Ranks; }

private:
  mutable Agreement Ranks;
  std::vector<NodeIndex> Firsts;
};

}

#endif
