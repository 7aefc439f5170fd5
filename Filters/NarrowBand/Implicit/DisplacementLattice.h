/**
 * The target's displacements at the points of a lattice of four voxels, each found once, and at the
 * nodes of a leaf, by linear interpolation.
 */
#ifndef DisplacementLattice_h
#define DisplacementLattice_h

#include "Leaves/LeafMask.h"
#include "Leaves/LeafTable.h"
#include "Target.h"

#include <cmath>
#include <vector>

namespace activesurface
{

/** Displacements of the target [voxels] at some points. A displacement that is not finite is
 * unknown: the target has no velocity there. */
inline bool IsKnown(const double* displacement)
{
  return std::isfinite(displacement[0] + displacement[1] + displacement[2]);
}

class TargetDisplacements
{
public:
  /** factor: from a velocity to voxels. */
  TargetDisplacements(const Target& target, double voxelSize, double factor)
    : Source(target)
    , VoxelSize(voxelSize)
    , Factor(factor)
  {
  }

  static constexpr std::size_t Most = 8; //< points at once

  /** At count points (x y z each, in voxels), Most at most. */
  void Evaluate(std::size_t count, const double* points, double* displacements) const;

  /** Calls function(n) for each n from first to end - 1: in parallel, if the target allows it. */
  template <class Function>
  void ForEach(std::size_t first, std::size_t end, Function&& function) const
  {
    if (this->Source.IsThreadSafe())
    {
      tbb::parallel_for(first, end, function);
      return;
    }
    for (std::size_t n = first; n < end; ++n)
    {
      function(n);
    }
  }

private:
  const Target& Source;
  double VoxelSize;
  double Factor;
};

/** The displacement at each node of a leaf, by axis: the mean of the known ones of the eight points
 * around the node, weighted as in linear interpolation; 0 where none is known. */
struct LeafDisplacements
{
  double Of[3][512];
  LeafMask Known;
};

class DisplacementLattice
{
public:
  /** The points in and at these leaves (origins, ascending). ranks: those that share the work, or
   * null. */
  DisplacementLattice(const std::vector<openvdb::Coord>& leaves,
    const TargetDisplacements& displacements, LeafOwners* ranks);

  /** One of the leaves. */
  void Interpolate(const openvdb::Coord& leaf, LeafDisplacements& values) const;

private:
  /** The eight points within a leaf. */
  struct Points
  {
    openvdb::Coord Leaf;
    unsigned Wanted; //< one bit each
    double Displacements[8][3];
  };

  void AddPoints(const std::vector<openvdb::Coord>& leaves);
  void Evaluate(Points& points, const TargetDisplacements& displacements) const;
  const Points& PointsOf(const openvdb::Coord& leaf) const;

  std::vector<Points> Leaves; //< ascending
};

}

#endif
