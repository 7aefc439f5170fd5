/**
 * The potential of shapes alone, from the nodes inside them and a function nearby.
 */
#ifndef PartBand_h
#define PartBand_h

#include "Leaves/ActiveSet.h"
#include "Parts/LatticeFunction.h"
#include "Parts/LeafSigns.h"

namespace activesurface
{

/**
 * A tree of u with background Far and inside tiles -Far, and its leaves with their layers. Leaves
 * exist where layers do.
 */
class PartBand
{
public:
  /** inside: the nodes inside the shapes; others are outside. Magnitudes are Far everywhere. */
  explicit PartBand(const LeafSigns& inside);

  std::size_t CountActive() const;

  /** Sets u in the layers to the first-order distances to the zero set of the function; see
   * PartDistances.h. */
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
