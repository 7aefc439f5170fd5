/**
 * Points at which the target is evaluated for single nodes, beside or instead of the sample points.
 */
#ifndef NodePoints_h
#define NodePoints_h

#include "LeafTable.h"
#include "Motion.h"

#include <cstddef>

namespace activesurface
{

struct SubstepBuffers;

/** Whether the crossings of the edges are sample points. */
inline bool SamplesCrossings(const Motion& motion)
{
  return motion.Evaluation == TargetEvaluation::Shifted;
}

/**
 * Appends to the `crossings` points that are there already one for each node that has its own, leaf
 * by leaf: with Node and ClosestPoint every active node, with Shifted none, or in the paper's
 * scheme those without a crossed edge (its F(X) beyond the surface). Returns the number of points.
 */
std::size_t AddNodePoints(const LeafTable& table, const PotentialTree& potential, double voxelSize,
  const Motion& motion, std::size_t crossings, SubstepBuffers& buffers);

}

#endif
