/**
 * Measures the displacement of the surface, which detects a steady state. Speeds at the nodes do
 * not: under tension, nodes off the surface keep changing while the surface stands still.
 */
#ifndef Displacement_h
#define Displacement_h

#include "Leaves/LeafTable.h"

#include <array>
#include <cstdint>
#include <vector>

namespace activesurface
{

/** The sample points at one time, to be compared with those at a later time. */
class Displacement
{
public:
  /** Copies the potential. */
  void Begin(const LeafTable& table);

  /** The largest distance along the normal [voxels] by which a sample point has moved since
   * Begin, on edges that are still crossed. Single precision adds noise of about 1e-7. */
  double GetLargest(const LeafTable& table) const;

  struct Statistics
  {
    double ShareBeyond; //< fraction of the sample points that moved farther than `distance`
    double Mean;        //< mean distance [voxels]
  };

  /** Returns statistics of the sample points of Begin; all 0 if there are none. A point whose
   * edge is no longer crossed counts as moved by a voxel, and as moved farther than any
   * `distance`. */
  Statistics GetStatistics(const LeafTable& table, double distance) const;

private:
  struct Leaf
  {
    openvdb::Coord Origin;
    std::array<LeafMask, 3> Edge;
    LeafMask Inside;
    std::array<std::int32_t, 3> Next; // next leaf, by axis
  };

  template <class Function>
  void ForEachPoint(const LeafTable& table, std::size_t i, Function&& function) const;

  std::vector<Leaf> Leaves;
  std::vector<float> Values; // 512 per leaf
};

}

#endif
