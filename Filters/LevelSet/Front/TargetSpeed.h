/**
 * The target's speed at every active node, from the sample points (section 4.3 of the paper, see
 * NarrowBand.h; corrected).
 *
 * With TargetEvaluation::Shifted, the speed of a node with crossed edges is the mean over the
 * sample points of these edges, weighted by 1/t^2. Here t is the fraction of the edge from the node
 * to the crossing. If F is linear, and the surface is a plane that crosses an edge of the node on
 * each axis, the mean is F at the closest point of the plane. In the paper's scheme all weights are
 * 1, and speeds are not extended. Otherwise sweeps extend the speed from nodes with crossed edges
 * to nodes farther from the surface. An extended speed is the mean over the neighbours with known
 * speeds, with the weight max(|u| - |u_n|, 0) for the neighbour n, or the plain mean if all weights
 * are 0.
 */
#ifndef TargetSpeed_h
#define TargetSpeed_h

#include "Base/Motion.h"
#include "Leaves/ActiveSet.h"

namespace activesurface
{

struct SubstepBuffers;

/**
 * Fills LargestSpeed, and SpeedOf = Attraction * (iso - F) at the nodes of these leaves that have
 * samples or a point of their own (NodePoints.h). The speed is 0 if all samples were dropped. These
 * leaves have to be sampled first. A speed lacks the samples of edges that begin in a leaf without
 * samples.
 */
void ApplySamples(
  const LeafTable& table, const LeafList& leaves, const Motion& motion, SubstepBuffers& buffers);

/** Extends the speed to the active nodes without samples in the affected leaves. Only with
 * TargetEvaluation::Shifted, and not in the paper's scheme. */
void ExtendSpeed(
  const LeafTable& table, const ActiveSet& set, const Motion& motion, SubstepBuffers& buffers);

/** Returns true if an exact control cancels the whole attraction: the surface is outside the
 * target's support, where the target's speed is inward and bitwise identical at all sample points.
 * All leaves have to be sampled. */
bool PullsInVain(const Motion& motion, const SubstepBuffers& buffers);

/** The largest |speed| at the crossings of a leaf, interpolated between the nodes. */
float LargestSpeedAtSurface(const LeafTable& table, std::size_t i, const SubstepBuffers& buffers);

}

#endif
