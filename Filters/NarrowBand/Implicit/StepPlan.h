/**
 * The length of an implicit substep, and what follows from it.
 *
 * A substep of length dt is displaced by d = F (1 - R) / L to a target of slope L, as the equation
 * u' = -Attraction F does exactly with R = exp(-a), a = Attraction L dt. With Tension, stages of
 *
 *   w' = Tension kappa |grad w| - a (w - u*) / dt,    w = u* at first, the displaced potential,
 *
 * follow. R is then the stages' own amplification at -a: so tension and attraction balance exactly
 * where they do in the equation.
 */
#ifndef StepPlan_h
#define StepPlan_h

#include "Implicit/LegendreStages.h"
#include "Motion.h"
#include "Substep/TimeStep.h"

#include <optional>

namespace activesurface
{

class StepPlan
{
public:
  /** slope: L, the largest target slope. The length is at most that of the motion's bounds, and
   * divides mostTime evenly if that is finite. */
  StepPlan(const Motion& motion, double voxelSize, double slope, const PenaltyForce& force,
    double mostTime);

  ///@{
  /** A substep that is 2^halvings times shorter. */
  StepPlan Halve(int halvings) const;
  /** This many substeps in one; and the same for slopes so small that the stages hardly damp. */
  StepPlan Join(int substeps) const;
  StepPlan JoinGently(int substeps) const;
  /** A substep of the same length, for another largest slope. */
  StepPlan ForSlope(double slope) const;
  /** One half of the displacement of this substep, without its tension: two of them make the whole.
   */
  StepPlan HalveDisplacement() const;
  ///@}

  double GetLength() const { return this->Length; }

  /** Whether the stages damp enough where the target has this slope. */
  bool Bears(double slope) const { return !this->Stages || slope <= this->Slope; }

  /** When the target has to be evaluated, as a share of the substep: so that a target that moves
   * evenly, of whose motion Transport has done its share already, is followed with the lag that the
   * equation has. */
  double GetSampleTime() const;

  /** The stages for Tension; none without. */
  const std::optional<LegendreStages>& GetStages() const { return this->Stages; }
  /** Tension dt / h^2, and the damping a, of all stages together. */
  double GetTension() const { return this->Tension; }
  double GetDamping() const { return this->Decay; }

  ///@{
  /** The factor from a target speed to its displacement in voxels where the slope is the largest;
   * and how many times as far a sample of another slope goes. */
  double GetFactor() const;
  double GetRatio(double slope) const;
  ///@}

  /** The displacement of the penalties [voxels]. */
  double GetUniformDisplacement() const;

  /** What stages have to subtract in all so that they displace by 1, against their damping. */
  double GetSourcePerDisplacement() const;

  /** q of the relaxation where the largest displacement is this [voxels]; Transport strains u too.
   */
  double GetRelaxation(double displacement) const;

private:
  void Derive();

  Motion Law;
  double VoxelSize;
  double Slope;
  PenaltyForce Force;
  double Length = 0.0;
  double Decay = 0.0;     //< a
  double Remaining = 1.0; //< R
  double Tension = 0.0;
  std::optional<LegendreStages> Stages;
};

/** How far a part of the surface may go in one pass [voxels], so that the layers hold what it comes
 * to. */
constexpr float LongestDisplacement = 1.f;

/** The same for tension where nothing balances it. */
constexpr float LongestDisplacementByTension = .5f;

}

#endif
