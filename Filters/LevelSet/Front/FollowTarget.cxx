#include "Front/FollowTarget.h"

#include "Front/ConvergedLeaves.h"
#include "Front/NodePoints.h"
#include "Front/SamplePoints.h"
#include "Front/SubstepBuffers.h"
#include "Front/TargetSpeed.h"

#include <algorithm>

namespace activesurface
{

namespace
{

/** Leaves converge only with Attraction and TargetEvaluation::Shifted, without controls, and not in
 * the paper's scheme. */
bool CanConverge(const Motion& motion)
{
  return motion.Attraction > 0.0 && motion.AreaControl == Control::None &&
    motion.VolumeControl == Control::None && SamplesCrossings(motion) && !motion.Paper;
}

/** sample: SampleLeaves, or SampleMore to keep existing samples. */
template <class Sampling>
void Sample(const FollowingBand& band, const LeafList& leaves, Sampling sample,
  const Motion& motion, const Target& target, AdvanceReport& report)
{
  const TargetSamples samples =
    sample({ band.Leaves, band.Potential, band.VoxelSize }, leaves, motion, target, band.Buffers);
  ApplySamples(band.Leaves, leaves, motion, band.Buffers);
  report.TargetEvaluations += samples.Count;
  report.DroppedSamples += samples.Dropped;
}

}

TargetLimits FollowTarget(const FollowingBand& band, const Motion& motion, bool mayLeaveOut,
  const Target& target, AdvanceReport& report)
{
  LeafTable& leaves = band.Leaves;
  const bool mayConverge = mayLeaveOut && CanConverge(motion);
  if (mayConverge)
  {
    ForgetChanged(leaves, band.VoxelSize, target);
  }
  else
  {
    ForgetSpeeds(leaves);
  }
  const LeafList unknown = FindUnknown(leaves);
  const LeafList sampled = leaves.FindAround(unknown);
  Sample(band, sampled, SampleLeaves, motion, target, report);
  RememberSpeeds(leaves, unknown, band.Buffers);
  const TargetLimits limits = FindLimits(leaves);
  report.MaxSpeed = std::max(report.MaxSpeed, limits.Speed);
  if (!mayConverge)
  {
    band.Set.ChooseAll(leaves);
    return limits;
  }
  const ConvergenceRule rule{ motion, band.VoxelSize, limits.TargetSlope };
  band.Set.Choose(leaves, leaves.FindAround(FindActiveLeaves(leaves, unknown, rule, band.Buffers)));
  const LeafList& affected = band.Set.Affected;
  if (!std::includes(sampled.begin(), sampled.end(), affected.begin(), affected.end()))
  {
    Sample(band, affected, SampleMore, motion, target, report);
  }
  return limits;
}

void ExtendToActiveNodes(const FollowingBand& band, const Motion& motion)
{
  if (HasTargetSpeed(motion))
  {
    ExtendSpeed(band.Leaves, band.Set, motion, band.Buffers);
  }
}

}
