/**
 * Where the search for new parts begins: the leaves that hold a node of one.
 */
#ifndef PartSeeds_h
#define PartSeeds_h

#include "Leaves/LeafTable.h"
#include "Parts/LatticeFunction.h"
#include "Parts/LeafSigns.h"
#include "Target.h"

#include <cmath>
#include <cstddef>
#include <vector>

namespace activesurface
{

/** What the search runs on: a band with its layers, and its target. */
struct PartSearch
{
  const LeafTable& Skin;
  const PotentialTree& Potential;
  double VoxelSize;
  const LatticeFunction& Target;
  std::size_t MaximumNumberOfActiveVoxels;
  double LeastRadius; //< of hollows and of the parts of shapes, what Tension leaves alive [length]

  /** The same in voxels, at least 1. */
  int GetLeastSteps() const;
};

/** The potential in a leaf of the lattice, of the band's or not. */
struct SkinLeaf
{
  const LeafMask* Inside;
  const LeafMask* LayerZero;

  SkinLeaf(const PartSearch& search, const openvdb::Coord& origin);
};

/** Whether the target and the skin are on different sides; not if the target is not a number. */
inline bool Differs(double target, bool isInside)
{
  return !std::isnan(target) && (target < 0.0) != isInside;
}

/** Adds leaves without nodes; what regions and parts of shapes add is told in NewParts.h. */
class PartSeeds
{
public:
  PartSeeds(const PartSearch& search, LeafSigns& leaves)
    : Search(search)
    , Leaves(leaves)
  {
  }

  void AddRegions(const Target& target);

  void AddPart(const TargetPart& part);

private:
  using Nodes = std::vector<openvdb::Coord>;

  /** Of some regions: the boxes of which all nodes count, and the centres that are to be looked at
   * as the skin is on their other side, unless the target is, too. */
  struct Candidates
  {
    std::vector<TargetRegion> Boxes;
    Nodes Centres;
  };

  Candidates LookAtAll(const Target& target) const;
  void Look(const TargetRegion& region, Candidates& found) const;
  /** The leaves of those at which the target differs from the skin, ascending. */
  Nodes FindLeaves(const Nodes& centres) const;
  bool IsInside(const openvdb::Coord& node) const;
  Nodes FindMissing(const Nodes& nodes, bool areHollow) const;
  bool IsWide(const openvdb::Coord& node, bool isHollow) const;

  const PartSearch& Search;
  LeafSigns& Leaves;
};

}

#endif
