/**
 * The target's speed at every active node, from the sample points (paper, section 4.3, corrected).
 *
 * A node with crossed edges takes the mean of their sample points weighted by 1/t^2, t the fraction
 * of the edge from the node to the crossing: for a plane that is the value at the exact closest
 * point. From there the speed is extended outward, round by round: the mean over the neighbours
 * known so far, weighted by how much nearer to the surface they are.
 */
#ifndef TargetSpeed_h
#define TargetSpeed_h

#include "LeafTable.h"
#include "Motion.h"

namespace activesurface
{

struct SubstepBuffers;

/**
 * Fills SpeedOf = -Attraction * (F - iso) at the active nodes, from the values at the sample points
 * and those at the nodes' own points (NodePoints.h). Nodes all of whose values were dropped stand
 * still. Returns the largest |speed|.
 */
double FindTargetSpeed(const LeafTable& table, const Motion& motion, SubstepBuffers& buffers);

/** The largest |speed| at the sample points, interpolated between the nodes. Takes the room of
 * LargestSpeed. */
double LargestSpeedAtSurface(const LeafTable& table, SubstepBuffers& buffers);

}

#endif
