/**
 * One implicit substep: the surface is displaced towards its target, by exponentials; then stages
 * make the tension (StepPlan.h).
 *
 * A target that carries the surface along does so once for all of the interval; rounds of
 * displacement and tension follow, in each of which the target is where it is at the end.
 */
#ifndef ImplicitStep_h
#define ImplicitStep_h

#include "Leaves/BandBackup.h"
#include "Substep/FollowTarget.h"
#include "Substep/StepForward.h"

#include <cstddef>

namespace activesurface
{

struct ImplicitBand
{
  FollowingBand Band;
  double Time;
  double MostTime; //< the substep is no longer
  bool MaySkip;    //< whether converged leaves may be left out
  std::size_t MaximumNumberOfActiveVoxels;
  BandBackup& Backup; //< of before the substep
};

struct ImplicitResult
{
  double Length = 0.0;
  int Rounds = 0;
  bool IsSkipped = false; //< as all leaves have converged
  bool PullsInVain = false;
  /** Of the surface, by all terms but exact controls and walls [voxels]; 0 where converged leaves
   * may be left out, as only AdvanceToSteadyState wants it. */
  double LargestDisplacement = 0.0;
  GradientCounts Gradients; //< before the last round
};

/** Makes the substep, layers and ghosts included. Where the gradients say Unbounded the band is as
 * before the pass that would have been so. */
ImplicitResult MakeImplicitStep(const ImplicitBand& band, const Motion& motion,
  const PenaltyForce& force, Target& target, AdvanceReport& report);

}

#endif
