/**
 * Halo of a rank: leaves of other ranks around its partition, with values that the owners send.
 */
#ifndef NodeHalo_h
#define NodeHalo_h

#include "Base/NodeTarget.h"
#include "Leaves/NodeArrays.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace activesurface
{

class Domain;

class NodeHalo
{
public:
  /** Collective. Removes leaves of other ranks from a shell, then appends the halo: shell leaves of
   * other ranks next to this rank's partition, with empty Rows. Keeps the order of own leaves.
   * Returns the number of own leaves. Without a domain all leaves are own. */
  std::size_t Find(const Domain* domain, std::vector<ShellLeaf>& shell);

  /** Collective. Replaces the numbers in halo leaves by those of the owners. Does nothing without a
   * domain. */
  void Refresh(const NodeArrays& numbers) const;

private:
  using Lists = std::vector<std::vector<std::size_t>>;

  void ListSent(const std::vector<ShellLeaf>& own);

  const Domain* Space = nullptr;
  Lists Sent;     // own leaves to be sent to each rank
  Lists Received; // leaves received from each rank
};

}

#endif
