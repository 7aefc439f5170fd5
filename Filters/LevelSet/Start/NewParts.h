/**
 * Finds parts of the target that the skin does not reach, and hollows of the target deep inside the
 * skin.
 *
 * Nodes where the signs of the target and of the potential differ are called differing. The skin
 * will reach a differing node if edges between differing nodes connect this node with layer 0,
 * where the sample points of the skin are. All other differing nodes form the new parts and
 * hollows. The search follows connected nodes, from the target's regions, and from parts of the
 * input shapes that the skin does not meet at all.
 * Hollows, and parts of input shapes, have to be wide (LeastRadius in PartSeeds.h): Tension or the
 * lattice would remove narrow parts, and the search would find these parts again.
 */
#ifndef NewParts_h
#define NewParts_h

#include "Base/Target.h"
#include "Start/LeafSigns.h"
#include "Start/PartSeeds.h"

#include <cstddef>
#include <vector>

namespace activesurface
{

class NewParts
{
public:
  /** Searches the regions and parts that the target reports. A node where the target is NaN does
   * not differ. Throws like RefuseManyLeaves. */
  NewParts(const PartSearch& search, const Target& target);

  /** Adds the nodes that change sides: nodes inside the skin if areInside, otherwise nodes outside.
   */
  void CopyNodes(bool areInside, LeafSigns& nodes) const;

  /** Number of new parts and hollows: sets of nodes connected along edges. A part that contains no
   * node is not counted. */
  std::size_t Count() const;

private:
  void SampleLeaf(const PartSearch& search, std::size_t i);
  /** Extends the reached nodes, starting in the leaves with numbers >= first and in their
   * neighbours. */
  void FindReached(std::size_t first);
  void AddNext(std::size_t begin, std::size_t end);
  void RemoveNarrowHollows(int steps);
  bool IsWide(const openvdb::Coord& node, int steps) const;

  LeafSigns Nodes;               // differing nodes; finally only those of new parts
  std::vector<LeafMask> Inside;  // nodes inside the skin
  std::vector<LeafMask> Reached; // differing nodes that the skin reaches
};

}

#endif
