/**
 * The stable length of a substep, and the coefficient of reinitialisation of a substep.
 */
#ifndef TimeStep_h
#define TimeStep_h

#include "Base/Motion.h"
#include "Front/SkinMeasure.h"

namespace activesurface
{

struct TargetLimits
{
  double Speed = 0.0;       //< largest |target speed| [length/time]
  double TargetSlope = 0.0; //< largest |dF/dn|
};

struct PenaltyForce
{
  double Speed = 0.0; //< uniform, outward [length/time]
  double Rate = 0.0;  //< added to the rate that limits the time step [1/time]
};

/** now, start: measures of the skin, in world units. */
PenaltyForce FindPenalty(const Motion& motion, const SkinMeasure& now, const SkinMeasure& start);

/** Return the area or volume to conserve: TargetArea or TargetVolume, or the value at the start.
 * Throw std::invalid_argument if this value is 0 or not finite. */
double HeldArea(const Motion& motion, const SkinMeasure& start);
double HeldVolume(const Motion& motion, const SkinMeasure& start);

/** Returns the sum of the target's rates [1/time] that limit the time step; see Motion::CFL. */
double TrackingRate(const Motion& motion, double voxelSize, const TargetLimits& limits);

/** CFL times the largest stable step [time]; infinite if nothing moves. The paper's scheme uses
 * PaperTimeStep. */
double StableStep(
  const Motion& motion, double voxelSize, const TargetLimits& limits, const PenaltyForce& penalty);

/** The coefficient q of reinitialisation. tracking: TrackingRate * step; advection: largest
 * displacement in the step without tension [voxels]. */
double RelaxationFor(double tracking, double advection);

/** Throws std::invalid_argument for invalid parameters. */
void CheckMotion(const Motion& motion);

/** Throws std::runtime_error if the remaining time needs a million of these steps or more, or if
 * the step is too small for single precision. */
void CheckStep(double step, double voxelSize, double remaining);

/** Throws std::runtime_error if a band has too many active nodes. */
void CheckSize(std::size_t count, std::size_t maximum);

/** Throws std::runtime_error if the potential would be unbounded after the substep that begins at
 * `time`. Called before the next potential is committed, so that the last bounded potential is
 * kept. No other check is needed: measures, output and displacements of a bounded potential are
 * finite, and the paper's scheme and the node scheme clamp the potential. */
void CheckBounded(bool isUnbounded, double time);

/** Returns the factor that converts a speed to voxels per step. */
float AdvectionFactor(double step, double voxelSize);

}

#endif
