/**
 * How long a substep may be, and how much slope relaxation it may do.
 */
#ifndef TimeStep_h
#define TimeStep_h

#include "Motion.h"
#include "Substep/SkinMeasure.h"

namespace activesurface
{

/** How the target limits the step. */
struct TargetLimits
{
  double Speed = 0.0; //< largest |target speed| [length/time]
  double Slope = 0.0; //< largest |dF/dn| met
};

/** What penalties do. */
struct PenaltyForce
{
  double Speed = 0.0; //< uniform, outward [length/time]
  double Rate = 0.0;  //< at which they limit the time step [1/time]
};

/** measure: of the skin now; start: when it started; both in world units. */
PenaltyForce FindPenalty(const Motion& motion, const SkinMeasure& now, const SkinMeasure& start);

/** What is to be held: the property, or the value at the start. Throws std::invalid_argument if
 * there is none. */
double HeldArea(const Motion& motion, const SkinMeasure& start);
double HeldVolume(const Motion& motion, const SkinMeasure& start);

/** Rate at which tracking the target limits the time step. */
double TrackingRate(const Motion& motion, double voxelSize, const TargetLimits& limits);

/** The largest stable step; infinite if nothing moves. */
double StableStep(
  const Motion& motion, double voxelSize, const TargetLimits& limits, const PenaltyForce& penalty);

/** The relaxation coefficient q for a step. */
double RelaxationFor(double tracking, double advection);

/** Throws std::invalid_argument for a motion that cannot be. */
void CheckMotion(const Motion& motion);

/** Throws std::runtime_error for a stable step that would take more than a million for the rest, or
 * whose speeds single precision does not hold. */
void CheckStep(double step, double voxelSize, double remaining);

/** What a speed is multiplied by to give voxels per step. */
float AdvectionFactor(double step, double voxelSize);

}

#endif
