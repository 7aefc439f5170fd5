/**
 * What one substep passes from hand to hand; kept from substep to substep for its memory.
 */
#ifndef SubstepBuffers_h
#define SubstepBuffers_h

#include "LeafMask.h"

#include <cstddef>
#include <vector>

namespace activesurface
{

struct SubstepBuffers
{
  // Per point of evaluation: the sample points in the order of NumberCrossings, then those of
  // single nodes (NodePoints.h).
  std::vector<double> Points; //< x y z
  std::vector<double> Values; //< F - iso
  std::vector<double> Slopes; //< bound of |dF/dn|

  // Per leaf, 512 nodes each.
  std::vector<float> Speed; //< extended target speed, valid where Known
  std::vector<float> Next;  //< potential after the substep
  std::vector<LeafMask> Known;
  std::vector<LeafMask> NextKnown;

  // Per leaf.
  std::vector<LeafMask> OwnPoint; //< nodes with a point of evaluation of their own
  std::vector<std::size_t> FirstOwnPoint;
  std::vector<float> LargestSpeed;
  std::vector<int> FlatNodes;  //< layer 0 nodes of slope below 1/sqrt 2
  std::vector<int> SteepNodes; //< layer 0 nodes of slope above sqrt 2
};

}

#endif
