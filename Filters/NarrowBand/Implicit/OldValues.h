/**
 * The potential before a carried leaf is overwritten, around the feet of its nodes.
 */
#ifndef OldValues_h
#define OldValues_h

#include "Leaves/LeafTable.h"

namespace activesurface
{

/** Where the values of the nodes of a leaf come from [voxels], by axis. */
struct LeafFeet
{
  double At[3][512];
};

class OldValues
{
public:
  OldValues(const LeafTable& table, const PotentialTree& tree, const LeafFeet& feet);

  /** Whether all values are the same, as no foot is near the surface. */
  bool IsUniform() const;

  /** u at the foot of a node by cubic polynomials; linearly where the band is too narrow for them;
   * + or - Far outside of it. */
  float Interpolate(int node) const;

private:
  void FindBox();
  void Gather();
  void GatherLeaf(const openvdb::Coord& origin);

  /** Where a node of the box is among the values. */
  int PlaceOf(int x, int y, int z) const
  {
    return ((x - this->First[0]) * this->Size[1] + (y - this->First[1])) * this->Size[2] +
      (z - this->First[2]);
  }

  /** Feet that lie farther apart are looked up one by one. */
  static constexpr int MostGathered = 24 * 24 * 24;

  const LeafTable& Table;
  const PotentialTree& Tree;
  const LeafFeet& Feet;
  int First[3]; //< of the box
  int Size[3];
  bool IsGathered = false;
  bool HasLayers = true;
  float Values[MostGathered]; // only those of the box are set
};

}

#endif
