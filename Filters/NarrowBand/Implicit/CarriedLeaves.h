/**
 * Where a surface goes that the target's velocity carries: which leaves it leaves, crosses and
 * reaches.
 */
#ifndef CarriedLeaves_h
#define CarriedLeaves_h

#include "Implicit/DisplacementLattice.h"
#include "Leaves/LeafTable.h"

#include <vector>

namespace activesurface
{

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
  void FindOrigins(const LeafTable& table);
  void AddDisplacement(const LeafTable& table, std::size_t i, std::vector<char>& isCarried);

  std::vector<double> Displacements;
  std::vector<openvdb::Coord> Origins;
};

}

#endif
