/**
 * The target's speed at every active node, from the sample points (paper, section 4.3, corrected).
 *
 * The speed of a node with crossed edges is the mean over their sample points weighted by 1/t^2, t
 * the fraction of the edge from the node to the crossing: for a plane that is the value at the
 * exact closest point. From there the speed is extended outward, round by round, as the mean over
 * the neighbours known so far, weighted by how much nearer to the surface they are.
 */
#ifndef TargetSpeed_h
#define TargetSpeed_h

#include "Leaves/ActiveSet.h"
#include "Motion.h"

namespace activesurface
{

struct SubstepBuffers;

/**
 * Fills SpeedOf = Attraction * (iso - F) at the nodes of these leaves that have samples or a point
 * of their own (NodePoints.h), and LargestSpeed. Where all samples were dropped the speed is 0.
 * These leaves, and those before them along the axes, have to be sampled first.
 */
void ApplySamples(
  const LeafTable& table, const LeafList& leaves, const Motion& motion, SubstepBuffers& buffers);

/** Extends the speed from there to the active nodes of the affected leaves. */
void ExtendSpeed(
  const LeafTable& table, const ActiveSet& set, const Motion& motion, SubstepBuffers& buffers);

/** Whether the target pulls inward everywhere alike, to the bit, as one out of reach does, and an
 * exact control will undo it. All leaves have to be sampled. */
bool PullsInVain(const Motion& motion, const SubstepBuffers& buffers);

/** The largest |speed| at the crossings of a leaf, interpolated between the nodes. */
float LargestSpeedAtSurface(const LeafTable& table, std::size_t i, const SubstepBuffers& buffers);

}

#endif
