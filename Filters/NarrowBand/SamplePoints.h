/**
 * The sample points: where the surface crosses the edges of the lattice (paper, section 4.3).
 */
#ifndef SamplePoints_h
#define SamplePoints_h

#include "LeafTable.h"
#include "Target.h"

#include <cstddef>
#include <vector>

namespace activesurface
{

struct SubstepBuffers;

/** What Evaluate found. */
struct TargetSamples
{
  std::size_t Count = 0;
  std::size_t Dropped = 0;   //< values that are not finite
  double LargestSlope = 0.0; //< L of the time step
};

/** World positions (x y z) of the crossings numbered by NumberCrossings, linear on the edges,
 * each computed once, from the edge's lower node. */
void FindSamplePoints(
  const LeafTable& table, double voxelSize, std::size_t count, std::vector<double>& points);

/** The target's value at each sample point, once each, in batches. */
TargetSamples EvaluateTarget(const Target& target, std::size_t count, SubstepBuffers& buffers);

}

#endif
