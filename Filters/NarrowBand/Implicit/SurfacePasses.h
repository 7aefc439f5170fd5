/**
 * The passes of an implicit substep over the leaves: the displacement, then the stages for tension.
 *
 * Leaves whose surface goes farther than the layers bear in one pass are fast: they and their
 * neighbours are left out of the pass, and make two passes of half the substep each, in which fast
 * leaves are treated likewise.
 */
#ifndef SurfacePasses_h
#define SurfacePasses_h

#include "Implicit/StageWeights.h"
#include "Implicit/StepPlan.h"
#include "Implicit/SurfaceMove.h"
#include "Motion.h"
#include "Substep/FollowTarget.h"

#include <vector>

namespace activesurface
{

constexpr int MostHalvings = 10;  //< of a substep, and again of a pass
constexpr double FewLeaves = .05; //< of those that the surface crosses: they may go farther

MoveCoefficients CoefficientsOf(const Motion& law, const StepPlan& plan);

class SurfacePasses
{
public:
  /** law: without Transport, whose share is done. */
  SurfacePasses(
    const FollowingBand& band, const Motion& law, Target& target, AdvanceReport& report);

  ///@{
  /** Moves the active leaves, whose target speeds are known; layers and ghosts follow: by one
   * substep; or by so many at once, of a surface that is calm. Returns the gradients before. Where
   * they say Unbounded the band is as before the pass that would have been so. */
  GradientCounts Run(const StepPlan& plan);
  GradientCounts RunJoined(const StepPlan& plan, int substeps);
  ///@}

  /** Whether the target is linear along what so many substeps displace the active leaves, in all
   * or without Tension in nearly all of them. */
  bool IsCalm(const StepPlan& plan, int substeps) const;

  /** The longest displacement of these leaves, by all terms but the controls. */
  float FindLargestDisplacement(const LeafList& leaves, const StepPlan& plan) const;

private:
  bool HasTarget() const { return this->Law.Attraction > 0.0; }
  bool IsWeighted() const { return HasTensionWeights(this->Law); }

  /** Leaves that go by the same plan. */
  struct LeafShare
  {
    LeafList Leaves;
    StepPlan Plan;
  };

  bool IsCalm(std::int32_t leaf, const StepPlan& plan) const;
  void MakeSubstep(const std::vector<LeafShare>& shares);
  void Displace(const LeafList& leaves, const StepPlan& plan, int halvings);
  void SampleAgain(const LeafList& leaves);
  bool TakeSlopesIntoAccount(std::size_t leaf, const StepPlan& plan, double scale);
  void TakeSlopesIntoAccount(const std::vector<LeafShare>& shares);
  void MakePass(const LeafList& leaves, const StepPlan& plan);
  float FindStrain(const LeafList& leaves, const StepPlan& plan) const;
  void Count(const GradientCounts& counts);
  void MakeTension(const LeafList& leaves, const StepPlan& plan);
  void Commit();

  const FollowingBand Band;
  LeafTable& Leaves;
  SubstepBuffers& Buffers;
  ActiveSet& Set;
  const Motion& Law;
  Target& Source;
  AdvanceReport& Report;

  GradientCounts Gradients;
  LeafList Moved;   //< by this run, or created by that
  LeafList Sourced; //< those of them whose displacement is left to the stages
  StageWeights Weights;
};

}

#endif
