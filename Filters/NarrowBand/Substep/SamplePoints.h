/**
 * The points at which the target is evaluated: where the surface crosses the edges of the lattice
 * (paper, section 4.3), and those of single nodes (NodePoints.h).
 */
#ifndef SamplePoints_h
#define SamplePoints_h

#include "Substep/NodePoints.h"
#include "Target.h"

#include <cstddef>

namespace activesurface
{

struct SubstepBuffers;

/** What SampleLeaves found. */
struct TargetSamples
{
  std::size_t Count = 0;
  std::size_t Dropped = 0; //< values that are not finite
};

/**
 * The target's value at each point of these leaves, once each, leaf by leaf: crossings, linear on
 * the edges, each from its edge's lower node, axis by axis, node by node; then those of single
 * nodes. Fills Samples and LargestSlope.
 */
TargetSamples SampleLeaves(const SampledLattice& lattice, const LeafList& leaves,
  const Motion& motion, const Target& target, SubstepBuffers& buffers);

/** The same for those of these leaves that have not been sampled, besides those that have. */
TargetSamples SampleMore(const SampledLattice& lattice, const LeafList& leaves,
  const Motion& motion, const Target& target, SubstepBuffers& buffers);

}

#endif
