/**
 * Which leaves have converged: there the surface has reached its target or, under Tension, the
 * balance of both.
 *
 * A leaf has converged if its surface is slower than a thousandth of a voxel times Attraction times
 * L. Without Tension the speed is that of the target at the sample points, interpolated between the
 * nodes. With Tension it is the rate of change of u at the nodes of crossed edges, divided by the
 * gradient norm: these nodes move the surface, and they are not relaxed. A leaf that has converged
 * together with its neighbours stays as it is, bitwise (except for the factor 2 that keeps gradient
 * norms near 1): further substeps would roughen the surface, and cost time.
 *
 * This is a rule of the scheme: it depends on the potential and the target alone. Speeds that
 * nothing has changed are kept, so that a converged leaf costs next to nothing; that does not
 * change the result.
 */
#ifndef ConvergedLeaves_h
#define ConvergedLeaves_h

#include "Leaves/LeafTable.h"
#include "Substep/TimeStep.h"
#include "Target.h"

namespace activesurface
{

struct SubstepBuffers;

/** What convergence depends on, besides the potential and the target. */
struct ConvergenceRule
{
  const Motion& Parameters;
  double VoxelSize;
  double TargetSlope; //< L, the largest |dF/dn| at the surface
};

/** Invalidates the speeds of all leaves. */
void ForgetSpeeds(LeafTable& table);

/** Invalidates the speeds of the leaves near which the target has changed. */
void ForgetChanged(LeafTable& table, double voxelSize, const Target& target);

/** The leaves whose speeds are not known. */
LeafList FindUnknown(const LeafTable& table);

/** Keeps the speeds of these leaves, which have been sampled with their neighbours; not yet
 * AtSurface. */
void RememberSpeeds(LeafTable& table, const LeafList& leaves, const SubstepBuffers& buffers);

/** The limits of all leaves, whose speeds have to be known. */
TargetLimits FindLimits(const LeafTable& table);

/** The leaves that have not converged. measured: those whose speeds have just become known. */
LeafList FindActiveLeaves(LeafTable& table, const LeafList& measured, const ConvergenceRule& rule,
  const SubstepBuffers& buffers);

}

#endif
