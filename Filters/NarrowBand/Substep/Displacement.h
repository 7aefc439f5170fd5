/**
 * How far the surface has moved: tells rest, where speeds at the nodes cannot, as those off the
 * surface go on moving under tension while the surface itself stands still.
 */
#ifndef Displacement_h
#define Displacement_h

#include "Leaves/LeafTable.h"

#include <array>
#include <cstdint>
#include <vector>

namespace activesurface
{

/** The sample points of a moment, to be compared with those of another one. */
class Displacement
{
public:
  /** Remembers the potential as it is. */
  void Begin(const LeafTable& table);

  /** The largest distance along the normal [voxels] by which a sample point has moved since, of
   * the edges that are still crossed. Stored in single precision, they tremble by about 1e-7. */
  double GetLargest(const LeafTable& table) const;

private:
  struct Leaf
  {
    openvdb::Coord Origin;
    std::array<LeafMask, 3> Edge;
    LeafMask Inside;
    std::array<std::int32_t, 3> Next; // leaf after it, by axis
  };

  double LargestOfLeaf(const LeafTable& table, std::size_t i) const;

  std::vector<Leaf> Leaves;
  std::vector<float> Values; // 512 per leaf
};

}

#endif
