/**
 * Points at which the target is evaluated for single nodes, in addition to the crossings of edges
 * or in place of the crossings.
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

/** Returns the nodes with points of their own. With TargetEvaluation Node or ClosestPoint: all
 * active nodes. Otherwise, in the paper's scheme: the active nodes without a crossed edge, where
 * the paper evaluates F(X). Otherwise: no nodes. */
LeafMask NodesWithOwnPoint(const LeafTable& table, const BandLeaf& leaf, const Motion& motion);

/** Writes the points of the leaf's NodesWithOwnPoint (x y z, world units); returns the end. */
double* WriteNodePoints(
  const SampledLattice& lattice, std::size_t leaf, const Motion& motion, double* point);

}

#endif
