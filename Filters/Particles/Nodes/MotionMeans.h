// Means of displacements and bulks of particles at the points of a leaf. With hasNoise, a mean
// displacement in a body is reduced by its noise, estimated from the variance of the displacements.

#ifndef MotionMeans_h
#define MotionMeans_h

#include "Base/NodeTarget.h"
#include "Nodes/ParticleRuns.h"

namespace activesurface
{

struct MotionColumns
{
  const float* Place[3]; // relative to the origin of the run's block
  const float* Displacement[3];
  const float* IsMoved; // 1, or 0 if the displacement is unknown
  const float* Bulk;    // null: all are 1
  const float* InverseReach2;
};

// Shifts of the runs are relative to the first node of the leaf.
void FindMotionMeans(
  const MotionColumns& columns, const ParticleRuns& runs, bool hasNoise, LeafMotion& motion);

}

#endif
