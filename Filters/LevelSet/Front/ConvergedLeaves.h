/**
 * Detects converged leaves: leaves whose surface has reached the target or, with Tension, the
 * balance of attraction and tension.
 *
 * A leaf has converged if its surface is not faster than 0.001 h Attraction L, where h is the voxel
 * size and L the target slope. Without Tension the speed is the target speed at the sample points,
 * interpolated between the ends of crossed edges; no target speed at the leaf's nodes of crossed
 * edges may exceed h Attraction L. With Tension the speed is the rate of change of u at the nodes
 * of crossed edges, divided by the gradient norm. Only these nodes determine the surface, and
 * reinitialisation does not change these nodes. A leaf that has converged together with its
 * neighbours is skipped: further substeps would roughen the surface. The values at the active nodes
 * of the leaf stay bitwise identical, except for factors of 2 that keep gradient norms near 1.
 *
 * Convergence depends only on the potential, the target and the motion. Stored speeds are used
 * again until the potential or the target may have changed, so a converged leaf costs very little.
 */
#ifndef ConvergedLeaves_h
#define ConvergedLeaves_h

#include "Base/Target.h"
#include "Front/TimeStep.h"
#include "Leaves/LeafTable.h"

namespace activesurface
{

struct SubstepBuffers;

/** Input of convergence, besides the potential and the target. */
struct ConvergenceRule
{
  const Motion& Parameters;
  double VoxelSize;
  double TargetSlope; //< L, the largest |dF/dn| at the surface
};

/** Invalidates the speeds of all leaves. */
void ForgetSpeeds(LeafTable& table);

/** Invalidates the speeds of the leaves near which the target may have changed. */
void ForgetChanged(LeafTable& table, double voxelSize, const Target& target);

/** Returns the leaves whose speeds are invalid. */
LeafList FindUnknown(const LeafTable& table);

/** Stores the speeds, except AtSurface, of leaves that have been sampled with their neighbours. */
void RememberSpeeds(LeafTable& table, const LeafList& leaves, const SubstepBuffers& buffers);

/** Returns the limits over all leaves, whose speeds have to be valid. */
TargetLimits FindLimits(const LeafTable& table);

/**
 * Returns the leaves that have not converged. measured: leaves whose speeds have just been stored.
 */
LeafList FindActiveLeaves(LeafTable& table, const LeafList& measured, const ConvergenceRule& rule,
  const SubstepBuffers& buffers);

}

#endif
