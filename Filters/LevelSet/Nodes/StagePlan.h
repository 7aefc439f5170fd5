/**
 * Number and durations of the stages of a frame of the node scheme (NodeStages.h).
 */
#ifndef StagePlan_h
#define StagePlan_h

namespace activesurface
{

/** Division of the coefficient of tension, b = Tension dt / h^2 (h: voxel size): the part up to
 * Fine uses differences over 2 nodes, the rest differences over 4 nodes. Differences over 2 nodes
 * are more accurate on thin parts, and need more stages. */
struct StagePlan
{
  int Count;
  float Fine;             //< at least b / 6, as differences over 4 nodes miss waves of 2 nodes
  const float* Durations; //< of the CycleLength stages of a cycle; Sum is over all stages
  int CycleLength;
  float Sum;

  /** Returns the duration of a stage; 1 is the frame. */
  float GetShare(int stage) const { return this->Durations[stage % this->CycleLength] / this->Sum; }
};

/** Stages of different durations (super time steps: Alexiades, Amiez, Gremaud 1996), in cycles of
 * five to seven stages. A cycle of n stages is stable over n^2 / 3 times the longest stable
 * duration of one stage. On a flat surface
 * - a frame multiplies a wave by at most about 0.1 (0.3 if attraction acts too), or by e^-g if that
 *   is larger; g: see GreatestFactor;
 * - before the frame's end, a wave has at most 1.2 times its size at the beginning;
 * - an error made after any stage of a cycle grows by a factor of at most 8.3 to the cycle's end.
 * tension: b, 0 to MostStageTension. */
StagePlan PlanCycles(float tension);

/** Stages of equal duration, for surfaces with NodeFreedom. With longer stages the surface would
 * show the limits of the freedom. tension: b, 0 to MostStageTension. */
StagePlan PlanEqualStages(float tension);

/** Limit of b. By r^2 = r0^2 - 4 b, curvature flow would remove a sphere of radius 2000 voxels in a
 * frame. */
constexpr float MostStageTension = 1e6f;

/** A single stage of the duration 1 would multiply a wave by 1 - g. Returns a bound of g / b, over
 * all waves and normals. f: fraction of b by differences over 2 nodes, 1/6 to 1. */
constexpr float GreatestFactor(float f)
{
  return 1.544f + 6.456f * f;
}

}

#endif
