/**
 * The potential before a carried leaf is overwritten, around the feet of its nodes.
 */
#ifndef OldValues_h
#define OldValues_h

#include "Leaves/LeafTable.h"

#include <vector>

namespace activesurface
{

class OldValues
{
public:
  /** feet: where the values of 512 nodes come from (x y z each) [voxels]. */
  OldValues(const LeafTable& table, const PotentialTree& tree, const double* feet);

  /** u at a foot by cubic polynomials; linearly where the band is too narrow for them; + or - Far
   * outside of it. */
  float Interpolate(const double* foot) const;

private:
  void Gather(const LeafTable& table, const PotentialTree& tree);
  void GatherLeaf(const LeafTable& table, const PotentialTree& tree, const openvdb::Coord& origin);
  /** Where a node of the box is among the values. */
  std::size_t PlaceOf(int x, int y, int z) const
  {
    return (static_cast<std::size_t>(x - this->First[0]) * this->Size[1] + (y - this->First[1])) *
      this->Size[2] +
      (z - this->First[2]);
  }

  const PotentialTree& Tree;
  int First[3]; //< of the box
  int Size[3];
  std::vector<float> Values;
};

}

#endif
