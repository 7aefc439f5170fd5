#include "Implicit/StepPlan.h"

#include "PortableMath.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace activesurface
{

namespace
{

// Attraction L dt at CFL 1; and with Tension, where the stages stand for the exponential.
constexpr double MostDecay = 2.0, MostDecayOfStages = 1.0;
constexpr int MostStages = 4;       // at CFL 1
constexpr double MostPenalty = 1.0; // the rate of the penalties times dt at CFL 1

StageOrder OrderFor(const Motion& motion)
{
  return motion.Attraction > 0.0 ? StageOrder::First : StageOrder::Second;
}

/** In units of the longest stable forward Euler step. With fewer stages than the damping would ask
 * for by itself, nothing comes to rest. */
double StageRate(const Motion& motion, double voxelSize, double decayRate)
{
  return 4.0 * std::fabs(motion.Tension) / (voxelSize * voxelSize) + .5 * decayRate;
}

/** Three bring the damping of 1 to within a hundredth of the exponential, two of a quarter. */
int LeastStages(StageOrder order, double decay)
{
  return order == StageOrder::First && decay <= .25 ? 2 : 3;
}

/** (1 - exp(-x)) / x. */
double MeanOfDecay(double x)
{
  return x > 1e-9 ? -ExponentialMinusOne(-x) / x : 1.0;
}

double LongestLength(
  const Motion& motion, double voxelSize, double slope, const PenaltyForce& force)
{
  const double decayRate = motion.Attraction * slope;
  const double stageRate = motion.Tension != 0.0 ? StageRate(motion, voxelSize, decayRate) : 0.0;
  const StageOrder order = OrderFor(motion);
  const double decay = motion.Tension != 0.0 ? MostDecayOfStages : MostDecay;
  const double longest = std::min({ decay / decayRate, MostPenalty / force.Rate,
    LegendreStages::Reach(order, MostStages) / stageRate }); // x / 0 is infinite
  return std::min(motion.CFL * longest, motion.LongestStep);
}

}

StepPlan::StepPlan(
  const Motion& motion, double voxelSize, double slope, const PenaltyForce& force, double mostTime)
  : Law(motion)
  , VoxelSize(voxelSize)
  , Slope(slope)
  , Force(force)
{
  const double longest = LongestLength(motion, voxelSize, slope, force);
  constexpr double rounding = 1e-9;
  this->Length = std::isfinite(mostTime)
    ? mostTime / std::max(1.0, std::ceil(mostTime / longest - rounding))
    : longest;
  this->Derive();
}

StepPlan StepPlan::Halve(int halvings) const
{
  StepPlan plan = *this;
  plan.Length = std::ldexp(this->Length, -halvings);
  plan.Derive();
  return plan;
}

StepPlan StepPlan::Join(int substeps) const
{
  StepPlan plan = *this;
  plan.Length = substeps * this->Length;
  plan.Derive();
  return plan;
}

StepPlan StepPlan::JoinGently(int substeps) const
{
  const StepPlan plan = this->Join(substeps);
  const bool isGentle = !plan.Stages || plan.Decay <= MostDecayOfStages;
  return isGentle ? plan : plan.ForSlope(plan.Slope * MostDecayOfStages / plan.Decay);
}

StepPlan StepPlan::ForSlope(double slope) const
{
  StepPlan plan = *this;
  plan.Slope = slope;
  plan.Derive();
  return plan;
}

StepPlan StepPlan::HalveDisplacement() const
{
  StepPlan half = *this;
  half.Length *= .5;
  half.Decay *= .5;
  half.Remaining = std::sqrt(this->Remaining);
  half.Stages.reset();
  return half;
}

void StepPlan::Derive()
{
  const double decayRate = this->Law.Attraction * this->Slope;
  this->Decay = decayRate * this->Length;
  this->Tension = this->Law.Tension * this->Length / (this->VoxelSize * this->VoxelSize);
  this->Stages.reset();
  this->Remaining = Exponential(-this->Decay);
  if (this->Law.Tension != 0.0)
  {
    const StageOrder order = OrderFor(this->Law);
    const double rate = StageRate(this->Law, this->VoxelSize, decayRate);
    this->Stages.emplace(order,
      std::max(
        LeastStages(order, this->Decay), LegendreStages::FindCount(order, rate * this->Length)));
    this->Remaining = this->Stages->Damp(this->Decay);
  }
}

double StepPlan::GetSampleTime() const
{
  const double transport = this->Law.Transport;
  const double lagging =
    this->Decay > 1e-6 ? 1.0 / (1.0 - this->Remaining) - 1.0 / this->Decay : .5;
  return transport + (1.0 - transport) * lagging;
}

double StepPlan::GetFactor() const
{
  return this->Length / (this->VoxelSize * this->GetSourcePerDisplacement());
}

double StepPlan::GetRatio(double slope) const
{
  const bool isOwn = slope != this->Slope && (!this->Stages || !(slope > 0.0));
  return isOwn
    ? MeanOfDecay(this->Law.Attraction * slope * this->Length) * this->GetSourcePerDisplacement()
    : 1.0;
}

double StepPlan::GetUniformDisplacement() const
{
  return this->Force.Speed * this->GetFactor();
}

double StepPlan::GetSourcePerDisplacement() const
{
  return this->Decay > 1e-9 ? this->Decay / (1.0 - this->Remaining) : 1.0;
}

double StepPlan::GetRelaxation(double displacement) const
{
  const double most = this->Stages ? 1.5 : 1.0; // stages move the gradient norm too
  const double strain = this->Law.Transport > 0.0 ? .5 : 0.0;
  return .3 * std::min(most, this->Decay + 1.5 * std::sqrt(3.0) * displacement + strain);
}

}
