/**
 * Points at which the target is evaluated: the surface's crossings of lattice edges (section 4.3 of
 * the paper, see NarrowBand.h), or one point for a node (NodePoints.h).
 */
#ifndef SamplePoints_h
#define SamplePoints_h

#include "Base/Target.h"
#include "Front/NodePoints.h"

#include <cstddef>

namespace activesurface
{

struct SubstepBuffers;

struct TargetSamples
{
  std::size_t Count = 0;
  std::size_t Dropped = 0; //< values that are not finite
};

/**
 * Evaluates the target once at each point of these leaves, leaf by leaf. In a leaf the crossings
 * come first (if SamplesCrossings), axis by axis, in the order of the lower nodes of the edges. The
 * points of NodesWithOwnPoint follow. A crossing is the zero of u interpolated linearly on the
 * edge. Fills Samples and LargestTargetSlope.
 */
TargetSamples SampleLeaves(const SampledLattice& lattice, const LeafList& leaves,
  const Motion& motion, const Target& target, SubstepBuffers& buffers);

/** Samples only those of the given leaves that have not been sampled; keeps existing samples. */
TargetSamples SampleMore(const SampledLattice& lattice, const LeafList& leaves,
  const Motion& motion, const Target& target, SubstepBuffers& buffers);

}

#endif
