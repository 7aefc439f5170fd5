/**
 * A band follows its target: which leaves are sampled in a substep, which of them move, and the
 * speed that the target gives them.
 */
#ifndef FollowTarget_h
#define FollowTarget_h

#include "Leaves/ActiveSet.h"
#include "Motion.h"
#include "Substep/TimeStep.h"
#include "Target.h"

namespace activesurface
{

struct SubstepBuffers;

struct FollowingBand
{
  LeafTable& Leaves;
  PotentialTree& Potential;
  double VoxelSize;
  ActiveSet& Set;
  SubstepBuffers& Buffers;
};

/** Samples the target, which has been moved to the time, chooses the active set, and gives the
 * nodes with samples in the affected leaves their speed. Converged leaves are left out if they may
 * be. */
TargetLimits FollowTarget(const FollowingBand& band, const Motion& motion, bool mayLeaveOut,
  const Target& target, AdvanceReport& report);

/** Extends speeds from there to the active nodes of the affected leaves. */
void ExtendToActiveNodes(const FollowingBand& band, const Motion& motion);

}

#endif
