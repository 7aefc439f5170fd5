/**
 * Points at which the target is evaluated for single nodes, besides or instead of the sample
 * points.
 */
#ifndef NodePoints_h
#define NodePoints_h

#include "Base/Motion.h"
#include "Leaves/LeafTable.h"

#include <cstddef>

namespace activesurface
{

/** A lattice for the points at which the target is evaluated. */
struct SampledLattice
{
  const LeafTable& Leaves;
  const PotentialTree& Potential;
  double VoxelSize;
};

/** Returns true if the crossed edges have sample points. */
inline bool SamplesCrossings(const Motion& motion)
{
  return motion.Evaluation == TargetEvaluation::Shifted;
}

/** Returns true if there are nodes with points of their own. */
inline bool HasNodePoints(const Motion& motion)
{
  return motion.Paper || !SamplesCrossings(motion);
}

/** Returns the nodes with points of their own. These are all active nodes with Node and
 * ClosestPoint, and none with Shifted. In the paper's scheme they are the nodes without a
 * crossed edge (its F(X) beyond the surface). */
LeafMask NodesWithOwnPoint(const LeafTable& table, const BandLeaf& leaf, const Motion& motion);

/** Writes the points of these nodes (x y z, world units), node by node; returns the end. */
double* WriteNodePoints(
  const SampledLattice& lattice, std::size_t leaf, const Motion& motion, double* point);

}

#endif
