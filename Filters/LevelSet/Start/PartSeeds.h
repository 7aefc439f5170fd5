/**
 * Finds leaves from which the search for new parts starts: leaves that may contain a node of a new
 * part or hollow.
 */
#ifndef PartSeeds_h
#define PartSeeds_h

#include "Base/Target.h"
#include "Leaves/LeafTable.h"
#include "Start/LatticeFunction.h"
#include "Start/LeafSigns.h"

#include <cmath>
#include <cstddef>
#include <vector>

namespace activesurface
{

/** Input of the search: a band with its layers, and its target. */
struct PartSearch
{
  const LeafTable& Skin;
  const PotentialTree& Potential;
  double VoxelSize;
  const LatticeFunction& Target;
  std::size_t MaximumNumberOfActiveVoxels;
  double LeastRadius; //< of a hollow, or part of a shape, that survives Tension [length]

  /** Returns LeastRadius in voxels, rounded up, within [1, 10^6]. */
  int GetLeastSteps() const;
};

/** Signs of the potential in a leaf of the lattice, which need not be in the band. */
struct SkinLeaf
{
  const LeafMask* Inside;
  const LeafMask* LayerZero;

  SkinLeaf(const PartSearch& search, const openvdb::Coord& origin);
};

/** Returns true if the target and the skin are on different sides; false if the target is NaN. */
inline bool Differs(double target, bool isInside)
{
  return !std::isnan(target) && (target < 0.0) != isInside;
}

/** Adds the leaves from which the search starts, with empty masks. TargetRegion.h describes the
 * seeds of regions. */
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

  /** Candidate seeds: boxes to be searched node by node, and region centres at which the signs of
   * the skin and of the target may differ. */
  struct Candidates
  {
    std::vector<TargetRegion> Boxes;
    Nodes Centres;
  };

  Candidates SearchAll(const Target& target) const;
  void SearchRegion(const TargetRegion& region, Candidates& found) const;
  /**
   * Returns the leaves of those centres at which the target differs from the skin, in ascending
   * order.
   */
  Nodes FindLeaves(const Nodes& centres) const;
  bool IsInside(const openvdb::Coord& node) const;
  Nodes FindMissing(const Nodes& nodes, bool areHollow) const;
  bool IsWide(const openvdb::Coord& node, bool isHollow) const;

  const PartSearch& Search;
  LeafSigns& Leaves;
};

}

#endif
