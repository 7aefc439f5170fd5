/**
 * Where a surface goes that the target's velocity carries: which leaves it leaves, crosses and
 * reaches.
 */
#ifndef CarriedLeaves_h
#define CarriedLeaves_h

#include "Leaves/LeafTable.h"
#include "Target.h"

#include <vector>

namespace activesurface
{

/** Displacements of the target [voxels] at some points. A displacement that is not finite is
 * unknown: the target has no velocity there. */
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

  static constexpr std::size_t Most = 27; //< points at once

  /** At count points (x y z each, in voxels), Most at most. */
  void Evaluate(std::size_t count, const double* points, double* displacements) const;

  bool IsThreadSafe() const { return this->Source.IsThreadSafe(); }

private:
  const Target& Source;
  double VoxelSize;
  double Factor;
};

class CarriedLeaves
{
public:
  /** The displacements are those from where the surface is. */
  CarriedLeaves(const LeafTable& table, const TargetDisplacements& displacements);

  /** Origins of all leaves, of the table or not, in which values may change; ascending. */
  const std::vector<openvdb::Coord>& GetOrigins() const { return this->Origins; }

  /** The longest displacement [voxels]. */
  double GetLongest() const;

  /** Whether what was near a node of a leaf of the table has gone, as the target said. */
  bool HasLeft(std::int32_t leaf, int node) const;

private:
  static constexpr int PointsPerLeaf = 8; //< at the centres of its eighths

  void Sample(const LeafTable& table, const TargetDisplacements& displacements, std::size_t i);
  void AddWay(const BandLeaf& leaf, const double* displacements);

  std::vector<double> Displacements;
  std::vector<openvdb::Coord> Origins;
};

}

#endif
