/**
 * Points at which the target is evaluated for single nodes, besides or instead of the sample
 * points.
 */
#ifndef NodePoints_h
#define NodePoints_h

#include "Leaves/LeafTable.h"
#include "Motion.h"

#include <cstddef>

namespace activesurface
{

/** A lattice at whose points the target is evaluated. */
struct SampledLattice
{
  const LeafTable& Leaves;
  const PotentialTree& Potential;
  double VoxelSize;
};

/** Whether the crossed edges have sample points. */
inline bool SamplesCrossings(const Motion& motion)
{
  return motion.Evaluation == TargetEvaluation::Shifted;
}

/** Whether there are nodes with points of their own. */
inline bool HasNodePoints(const Motion& motion)
{
  return motion.Paper || !SamplesCrossings(motion);
}

/** The nodes with points of their own: all active nodes with Node and ClosestPoint; none with
 * Shifted, but in the paper's scheme those without a crossed edge (its F(X) beyond the surface). */
LeafMask NodesWithOwnPoint(const LeafTable& table, const BandLeaf& leaf, const Motion& motion);

/** Writes their points (x y z, world units), node by node; returns the end. */
double* WriteNodePoints(
  const SampledLattice& lattice, std::size_t leaf, const Motion& motion, double* point);

}

#endif
