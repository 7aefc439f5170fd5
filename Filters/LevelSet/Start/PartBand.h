/**
 * Builds the potential of new shapes from their inside nodes and the values of a function in the
 * layers.
 */
#ifndef PartBand_h
#define PartBand_h

#include "Leaves/ActiveSet.h"
#include "Start/LatticeFunction.h"
#include "Start/LeafSigns.h"

namespace activesurface
{

/**
 * A tree of u with background Far and inside tiles -Far, and its leaves with the layers. The tree
 * has no leaves without layers.
 */
class PartBand
{
public:
  /** inside: nodes inside the shapes; all other nodes are outside. Sets all magnitudes of u to Far.
   */
  explicit PartBand(const LeafSigns& inside);

  std::size_t CountActive() const;

  /** Sets u in the layers to the first-order distances to the zero set of the function; see
   * PartDistances. */
  void FindDistances(const LatticeFunction& function);

  const openvdb::FloatTree::Ptr& GetTree() const { return this->Tree; }
  const LeafTable& GetLeaves() const { return this->Leaves; }

private:
  void AddLeaf(const LeafSigns& inside, std::size_t i);

  openvdb::FloatTree::Ptr Tree;
  LeafTable Leaves;
};

}

#endif
