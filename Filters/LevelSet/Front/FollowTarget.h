/**
 * Makes a band follow its target: chooses the leaves to sample and to move in a substep, and
 * applies the target's speed.
 */
#ifndef FollowTarget_h
#define FollowTarget_h

#include "Base/Motion.h"
#include "Base/Target.h"
#include "Front/TimeStep.h"
#include "Leaves/ActiveSet.h"

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

/** Samples the target at its current time, and chooses the active set. In the affected leaves, sets
 * the speed of the nodes with samples. Omits converged leaves if mayLeaveOut and leaves can
 * converge (CanConverge in FollowTarget.cxx). */
TargetLimits FollowTarget(const FollowingBand& band, const Motion& motion, bool mayLeaveOut,
  const Target& target, AdvanceReport& report);

void ExtendToActiveNodes(const FollowingBand& band, const Motion& motion);

}

#endif
