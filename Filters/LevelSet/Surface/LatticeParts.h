/**
 * The connected parts of a shape on a lattice, and its hollows.
 */
#ifndef LatticeParts_h
#define LatticeParts_h

#include "ActiveLevelSetExport.h"
#include "Base/TargetRegion.h"

#include <memory>
#include <vector>

namespace activesurface
{

struct LatticeShape;

/**
 * Two nodes on the same side are in one part or hollow if nodes on that side connect them along
 * edges. Outside nodes that are connected with the background, the unbounded outside, are not in a
 * hollow. The constructor searches leaves and tiles.
 */
class ACTIVELEVELSET_EXPORT LatticeParts
{
public:
  explicit LatticeParts(const LatticeShape& shape);
  ~LatticeParts();
  LatticeParts(const LatticeParts&) = delete;
  void operator=(const LatticeParts&) = delete;

  /** Visits parts and hollows in an order that depends only on the shape. */
  void ForEachPart(const PartVisitor& visit) const;

private:
  std::vector<std::unique_ptr<TargetPart>> Parts;
};

}

#endif
