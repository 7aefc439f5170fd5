/**
 * Points at which the target is evaluated for single nodes, beside or instead of the sample points.
 */
#ifndef NodePoints_h
#define NodePoints_h

#include "Leaves/LeafTable.h"
#include "Motion.h"

#include <cstddef>

namespace activesurface
{

/** The lattice whose leaves these are. */
struct SampledLattice
{
  const LeafTable& Leaves;
  const PotentialTree& Potential;
  double VoxelSize;
};

/** Whether the crossings of the edges are sample points. */
inline bool SamplesCrossings(const Motion& motion)
{
  return motion.Evaluation == TargetEvaluation::Shifted;
}

/** Whether there are nodes with points of their own. */
inline bool HasNodePoints(const Motion& motion)
{
  return motion.Paper || !SamplesCrossings(motion);
}

/** Which they are: with Node and ClosestPoint all active nodes, with Shifted none, or in the
 * paper's scheme those without a crossed edge (its F(X) beyond the surface). */
LeafMask NodesWithOwnPoint(const LeafTable& table, const BandLeaf& leaf, const Motion& motion);

/** Their points (x y z, world units), node by node; returns their end. */
double* WriteNodePoints(
  const SampledLattice& lattice, std::size_t leaf, const Motion& motion, double* point);

}

#endif
