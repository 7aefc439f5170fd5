/**
 * The points at which the target is evaluated: where the surface crosses lattice edges (paper,
 * section 4.3), and the points of single nodes (NodePoints.h).
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
 * Evaluates the target once at each point of these leaves, leaf by leaf: first at the crossings,
 * which are linear on the edges, axis by axis, by the lower node of the edge; then at the points of
 * single nodes. Fills Samples and LargestTargetSlope.
 */
TargetSamples SampleLeaves(const SampledLattice& lattice, const LeafList& leaves,
  const Motion& motion, const Target& target, SubstepBuffers& buffers);

/** The same for those of these leaves that have not been sampled yet; keeps the other samples. */
TargetSamples SampleMore(const SampledLattice& lattice, const LeafList& leaves,
  const Motion& motion, const Target& target, SubstepBuffers& buffers);

}

#endif
