/**
 * The ranks that own space near a place.
 */
#ifndef RanksAround_h
#define RanksAround_h

#include "ActiveNarrowBandExport.h"
#include "IndexMap.h"
#include "NodeTarget.h"

#include <vector>

namespace activesurface
{

class Domain;

/** By cells of 16 nodes a side: all nodes of a cell have the same ranks around them. */
class ACTIVENARROWBAND_EXPORT RanksAround
{
public:
  /** margin: distance along each axis from the cell [nodes]. The domain is the caller's. */
  RanksAround(const Domain& domain, int margin);

  static NodeIndex CellOf(const NodeIndex& node)
  {
    constexpr int bits = 4;
    return { node[0] >> bits, node[1] >> bits, node[2] >> bits };
  }

  /** The ranks that own leaves within the margin of a cell. Valid until the next call. */
  const std::vector<int>& Find(const NodeIndex& cell);

private:
  const Domain& Space;
  const int Margin;
  IndexMap Numbers;
  std::vector<std::vector<int>> Ranks; // by the cells' numbers
  NodeIndex Last{};
  std::size_t LastNumber = 0;
};

}

#endif
