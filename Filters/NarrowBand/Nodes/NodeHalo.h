/**
 * The leaves of other ranks around those of this rank: their owners send what is in them.
 */
#ifndef NodeHalo_h
#define NodeHalo_h

#include "Leaves/NodeArrays.h"
#include "NodeTarget.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace activesurface
{

class Domain;

class NodeHalo
{
public:
  /** Leaves in a shell the leaves that this rank owns, in their order; adds those of other ranks
   * around its space, with no rows. Returns how many are own. Collective. Without a domain all are
   * own. */
  std::size_t Find(const Domain* domain, std::vector<ShellLeaf>& shell);

  /** Replaces the numbers in the leaves of other ranks by those of their owners. Collective; does
   * nothing without a domain. */
  void Refresh(const NodeArrays& numbers) const;

private:
  using Lists = std::vector<std::vector<std::size_t>>;

  void ListSent(const std::vector<ShellLeaf>& own);

  const Domain* Space = nullptr;
  Lists Sent;     // own leaves, for each rank
  Lists Received; // leaves of each rank
};

}

#endif
