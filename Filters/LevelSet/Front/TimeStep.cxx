#include "Front/TimeStep.h"

#include "Base/Tension.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace activesurface
{

namespace
{

/** Advection by minmod-limited differences is stable (the total variation does not grow) up to a
 * displacement of 2/3 voxel in the 1-norm. The 1-norm of a velocity is at most sqrt 3 times the
 * speed. */
double AdvectionRate(double speed, double voxelSize)
{
  return 1.5 * std::sqrt(3.0) * speed / voxelSize;
}

double Held(double wanted, double start, const char* name)
{
  const double held = wanted > 0.0 ? wanted : start;
  if (!(held > 0.0) || !std::isfinite(held))
  {
    throw std::invalid_argument(std::string(name) +
      "Control has nothing to conserve, because the initial skin is empty; set Target" + name +
      " to a finite number > 0, or the control to NONE.");
  }
  return held;
}

void Require(bool condition, const char* sentence)
{
  if (!condition)
  {
    throw std::invalid_argument(sentence);
  }
}

bool IsZeroOrPositive(double value)
{
  return std::isfinite(value) && value >= 0.0;
}

}

double HeldArea(const Motion& motion, const SkinMeasure& start)
{
  return Held(motion.TargetArea, start.Area, "Area");
}

double HeldVolume(const Motion& motion, const SkinMeasure& start)
{
  return Held(motion.TargetVolume, start.Volume, "Volume");
}

PenaltyForce FindPenalty(const Motion& motion, const SkinMeasure& now, const SkinMeasure& start)
{
  PenaltyForce penalty;
  if (motion.AreaControl == Control::Penalty)
  {
    const double held = HeldArea(motion, start);
    penalty.Speed += motion.AreaStiffness * (held - now.Area) / held;
    penalty.Rate += motion.AreaStiffness * AreaGainOfSphere(now.Area) / held;
  }
  if (motion.VolumeControl == Control::Penalty)
  {
    const double held = HeldVolume(motion, start);
    penalty.Speed += motion.VolumeStiffness * (held - now.Volume) / held;
    penalty.Rate += motion.VolumeStiffness * now.Area / held;
  }
  return penalty;
}

double TrackingRate(const Motion& motion, double voxelSize, const TargetLimits& limits)
{
  return AdvectionRate(limits.Speed, voxelSize) + motion.Attraction * limits.TargetSlope;
}

// Adds the rates of all terms; with only the largest rate, the skin would flicker at a steady
// state.
double StableStep(
  const Motion& motion, double voxelSize, const TargetLimits& limits, const PenaltyForce& penalty)
{
  const double rate = TrackingRate(motion, voxelSize, limits) +
    AdvectionRate(std::fabs(penalty.Speed), voxelSize) + penalty.Rate +
    TensionRate(motion.Tension, voxelSize);
  return rate > 0.0 ? motion.CFL / rate : std::numeric_limits<double>::infinity();
}

// The rate of reinitialisation grows with `tracking`, because a fixed rate would bias tension.
// Reinitialisation and advection use the same one-sided differences, and amplify each other unless
// the sum of their rates is at most 1/2.
double RelaxationFor(double tracking, double advection)
{
  return std::max(0.0, std::min(0.3 * std::min(1.0, tracking), 0.5 - advection));
}

void CheckMotion(const Motion& motion)
{
  Require(IsZeroOrPositive(motion.Attraction), "Attraction must be a finite number >= 0.");
  Require(std::isfinite(motion.Tension), "Tension must be a finite number.");
  Require(
    motion.Transport >= 0.0 && motion.Transport <= 1.0, "Transport must be a number in [0,1].");
  Require(!motion.Paper || (motion.Transport == 0.0 && !motion.WeightedTension),
    "The paper's scheme has neither Transport nor WeightedTension; set Transport to 0 and "
    "WeightedTension to false, or Paper to false.");
  Require(motion.CFL > 0.0 && std::isfinite(motion.CFL), "CFL must be a finite number > 0.");
  Require(motion.LongestStep > 0.0, "LongestStep must be a number > 0.");
  Require(IsZeroOrPositive(motion.AreaStiffness) && IsZeroOrPositive(motion.VolumeStiffness),
    "AreaStiffness and VolumeStiffness must be finite numbers >= 0.");
  Require(IsZeroOrPositive(motion.TargetArea) && IsZeroOrPositive(motion.TargetVolume),
    "TargetArea and TargetVolume must be finite numbers > 0, or 0 for the values of the initial "
    "skin.");
  Require(motion.AreaControl != Control::Exact || motion.VolumeControl != Control::Exact,
    "AreaControl and VolumeControl cannot both be EXACT, as one displacement cannot restore two "
    "numbers; make one of them PENALTY.");
  Require(motion.Integration == TimeIntegration::Explicit || motion.Tension >= 0.0,
    "The node scheme needs a Tension >= 0; raise Tension, or set TimeIntegration to EXPLICIT.");
  Require(!motion.CreateParts || !motion.Paper,
    "The paper's scheme cannot create parts; set Paper or CreateParts to false.");
}

void CheckStep(double step, double voxelSize, double remaining)
{
  constexpr double mostSubsteps = 1e6;
  const bool isTooSmall = !(step / voxelSize >= std::numeric_limits<float>::min());
  const bool isTooOften = std::isfinite(remaining) && !(step * mostSubsteps > remaining);
  if (isTooSmall || isTooOften)
  {
    std::ostringstream text;
    text << "The stable time step is " << step << ", ";
    if (isTooOften)
    {
      text << "so the remaining motion time " << remaining << " needs a million substeps or more";
    }
    else
    {
      text << "too small for single precision";
    }
    text << "; lower Attraction, TargetReach, Tension, AreaStiffness, VolumeStiffness, TimeScale "
         << "or the interval of time steps (TimeStepSize), raise CFL, ArrivalTime, VoxelSize, "
         << "TargetArea or TargetVolume, or turn NormalizeTarget on.";
    throw std::runtime_error(text.str());
  }
}

void CheckSize(std::size_t count, std::size_t maximum)
{
  if (count > maximum)
  {
    std::ostringstream text;
    text << "The narrow band has at least " << count << " active voxels, counted or estimated from "
         << "the target, more than MaximumNumberOfActiveVoxels = " << maximum
         << "; enlarge VoxelSize, check that the target is bounded, or raise the maximum.";
    throw std::runtime_error(text.str());
  }
}

void CheckBounded(bool isUnbounded, double time)
{
  if (isUnbounded)
  {
    std::ostringstream text;
    text << "The skin stays at the motion time " << time
         << " (TimeScale * elapsed time), because the next substep would make the potential "
         << "diverge. Lower CFL, or remove infinite values from the target. Over an unbounded "
         << "target, set GradientScheme to UPWIND or BoundedDomain to on.";
    throw std::runtime_error(text.str());
  }
}

// Limited to finite floats: infinity times the speed 0 would be NaN.
float AdvectionFactor(double step, double voxelSize)
{
  constexpr double most = std::numeric_limits<float>::max();
  return static_cast<float>(std::min(step / voxelSize, most));
}

}
