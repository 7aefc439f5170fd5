/**
 * How far the surface has moved. It tells whether the surface is steady; speeds at the nodes do
 * not, because nodes off the surface go on changing under tension while the surface stands still.
 */
#ifndef Displacement_h
#define Displacement_h

#include "Leaves/LeafTable.h"

#include <array>
#include <cstdint>
#include <vector>

namespace activesurface
{

/** The sample points at one moment, to be compared with those at a later one. */
class Displacement
{
public:
  /** Copies the potential. */
  void Begin(const LeafTable& table);

  /** The largest distance along the normal [voxels] by which a sample point has moved since, on
   * edges that are still crossed. Single precision adds noise of about 1e-7. */
  double GetLargest(const LeafTable& table) const;

  /** The share of the edges that were crossed at Begin whose sample point has moved farther than a
   * distance [voxels], or that are no longer crossed. 0 without edges. */
  double GetShareBeyond(const LeafTable& table, double distance) const;

  /** The mean distance [voxels] by which the sample points of Begin have moved; one that is gone
   * counts as a voxel. 0 without edges. */
  double GetMean(const LeafTable& table) const;

private:
  struct Leaf
  {
    openvdb::Coord Origin;
    std::array<LeafMask, 3> Edge;
    LeafMask Inside;
    std::array<std::int32_t, 3> Next; // leaf after it, by axis
  };

  template <class Function>
  void ForEachPoint(const LeafTable& table, std::size_t i, Function&& function) const;

  std::vector<Leaf> Leaves;
  std::vector<float> Values; // 512 per leaf
};

}

#endif
