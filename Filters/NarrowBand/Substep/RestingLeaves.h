/**
 * Which leaves rest: where a surface has arrived, on its target or, under Tension, where both
 * balance.
 *
 * A leaf is at rest when its surface is slower than a thousandth of a voxel times Attraction times
 * L. Without Tension that is the target's speed at its sample points, interpolated between the
 * nodes; with it, how fast u changes at the nodes of crossed edges, over its slope: they are what
 * moves the surface, and are not relaxed. The leaf stays as it is, to the bit (but for the factor 2
 * that keeps slopes near 1), as long as its neighbours are at rest as well: going on would roughen
 * the surface, and cost time. This is a rule of the scheme, for the potential and the target alone
 * decide; that speeds are remembered where nothing has changed them, so that such a leaf costs next
 * to nothing, leaves no trace.
 */
#ifndef RestingLeaves_h
#define RestingLeaves_h

#include "Leaves/LeafTable.h"
#include "Substep/TimeStep.h"
#include "Target.h"

namespace activesurface
{

struct SubstepBuffers;

/** What decides on rest, besides the potential and the target. */
struct RestRule
{
  const struct Motion& Motion;
  double VoxelSize;
  double Slope; //< L
};

/** Forgets the speed of all leaves. */
void ForgetSpeeds(LeafTable& table);

/** Forgets the speed of the leaves near which the target has changed. */
void ForgetChanged(LeafTable& table, double voxelSize, const Target& target);

/** The leaves whose speed is not known. */
LeafList FindUnknown(const LeafTable& table);

/** Remembers the speed of these leaves, which have been sampled with their neighbours. AtSurface
 * comes later. */
void RememberSpeeds(LeafTable& table, const LeafList& leaves, const SubstepBuffers& buffers);

/** Of all leaves, whose speeds have to be known. */
TargetLimits FindLimits(const LeafTable& table);

/** The leaves that are not at rest. measured: those whose speed has just become known. */
LeafList FindUnrest(
  LeafTable& table, const LeafList& measured, const RestRule& rule, const SubstepBuffers& buffers);

}

#endif
