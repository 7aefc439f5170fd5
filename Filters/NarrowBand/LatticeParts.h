/**
 * The connected parts of a shape on a lattice, and its hollows.
 */
#ifndef LatticeParts_h
#define LatticeParts_h

#include "ActiveNarrowBandExport.h"
#include "TargetRegion.h"

#include <memory>
#include <vector>

namespace activesurface
{

struct LatticeShape;

/**
 * Nodes of one side are connected along edges. What is connected with the background, the unbounded
 * outside, is no hollow. They are found by leaves and tiles, once: the cost goes with the surface.
 */
class ACTIVENARROWBAND_EXPORT LatticeParts
{
public:
  explicit LatticeParts(const LatticeShape& shape);
  ~LatticeParts();
  LatticeParts(const LatticeParts&) = delete;
  void operator=(const LatticeParts&) = delete;

  /** In an order that depends on the shape alone. */
  void ForEachPart(const PartVisitor& visit) const;

private:
  std::vector<std::unique_ptr<TargetPart>> Parts;
};

}

#endif
