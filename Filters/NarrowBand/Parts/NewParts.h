/**
 * Parts of the target that no skin reaches, and hollows of it deep inside the skin.
 *
 * At the nodes where the signs of the target and of the potential differ, the skin is not yet where
 * it goes. Those that are connected, along edges, with a node of layer 0 it reaches by itself: its
 * sample points are there. The others it never reaches: between them and the skin is a gap in which
 * the target moves the skin away. These are new parts, and new hollows. They are searched for from
 * the regions on, as far as they are connected; and from the parts of the shapes that the target
 * goes between which the skin does not meet at all: of those that it meets it holds some already.
 * A hollow is one where it is wide: narrower ones Tension or the lattice closes, to be found again.
 */
#ifndef NewParts_h
#define NewParts_h

#include "Parts/LeafSigns.h"
#include "Parts/PartSeeds.h"
#include "Target.h"

#include <cstddef>
#include <vector>

namespace activesurface
{

class NewParts
{
public:
  /** The target's parts where it tells of them. A value of the target that is not a number has the
   * sign of the potential. Throws as RefuseManyLeaves does. */
  NewParts(const PartSearch& search, const Target& target);

  /** Adds the nodes that change sides: those that are outside the skin now, or inside it. */
  void CopyNodes(bool areInside, LeafSigns& nodes) const;

  /** How many there are: connected along edges. Those of less than a node are none. */
  std::size_t Count() const;

private:
  void SampleLeaf(const PartSearch& search, std::size_t i);
  /** Of leaves from `first` on and those next to them. */
  void FindReached(std::size_t first);
  void AddNext(std::size_t begin, std::size_t end);
  void RemoveNarrowHollows(int steps);
  bool IsWide(const openvdb::Coord& node, int steps) const;

  LeafSigns Nodes;               // that differ; in the end, those of the parts
  std::vector<LeafMask> Inside;  // inside the skin
  std::vector<LeafMask> Reached; // of the nodes that differ, those that the skin reaches
};

}

#endif
