#include "Simulation/MotionWarnings.h"

#include "Targets/Warnings.h"

#include <iomanip>
#include <sstream>

namespace activesurface
{

void WarnOfMotion(const AdvanceReport& report, const MotionEnd& end, Warnings& messages)
{
  const MotionTime time = end.Time;
  if (report.Vanished && !end.WasEmpty && !report.Aborted)
  {
    std::ostringstream text;
    text << "The skin has vanished before the motion time " << time.Value
         << (end.MayComeBack ? "; it reappears where the target does, unless Tension is too "
                               "large."
                             : "; it does not reappear. Check that the target exists until then "
                               "and overlaps the initial shape. Turn CreateParts on, if off; "
                               "lower Tension, if set.");
    messages.Say("vanished", text.str());
  }
  if (report.Substeps > 0 && report.UniformPulls == report.Substeps)
  {
    std::ostringstream text;
    text
      << "Before the motion time " << time.Value
      << " the target attracted the skin inward at the same speed everywhere. VolumeControl or "
      << "AreaControl EXACT cancels such an attraction, so the skin did not approach the target, "
      << "which is empty, outside the skin, or farther inside than TargetReach. Check that target "
      << "and initial shape overlap. If the target is inside the skin, raise TargetReach.";
    messages.Say("cancelled attraction", text.str());
  }
  if (report.DroppedSamples > 0)
  {
    std::ostringstream text;
    text << "Before the motion time " << time.Value << " the target was not a finite number in "
         << report.DroppedSamples << " of " << report.TargetEvaluations
         << " evaluations near the skin, which were ignored. Check the target for values that "
         << "are not finite.";
    messages.Say("not finite", text.str());
  }
}

void WarnOfOutside(const Outside& outside, Warnings& messages)
{
  constexpr double most = 0.01;
  if (!(outside.Share > most))
  {
    return;
  }
  const bool particles = outside.ParticlesAreLost;
  const bool isHeld = outside.Parameters.VolumeControl != Control::None ||
    outside.Parameters.AreaControl != Control::None;
  std::ostringstream text;
  text << "At the time " << outside.Time.Value << ", "
       << std::setprecision(outside.Share < .1 ? 2 : 3) << 100.0 * outside.Share << " % of the "
       << (particles ? "particles are outside the skin by more than their own radius"
                     : "target is outside the skin")
       << "; the column Outside of the history has this fraction for each time step. "
       << (isHeld ? "VolumeControl or AreaControl may keep the skin too small for the target. "
                  : "")
       << "For a closer skin, reduce VoxelSize"
       << (outside.Parameters.Tension > 0.0 ? " or lower Tension" : "")
       << (outside.Parameters.CreateParts ? "" : "; turn CreateParts on and PaperScheme off")
       << ". For time steps after the first, and for EQUILIBRIUM, also raise Attraction or, if the "
       << "target moves, "
       << (particles && outside.Parameters.Transport < 1.0
              ? "use Transport 1 without explicit substeps, or "
              : "")
       << "shorten the time between time steps.";
  messages.Say("outside", text.str());
}

std::string DescribeRest(const AdvanceReport& report)
{
  if (!report.IsSteady || report.MovingShare == 0.0)
  {
    return report.IsSteady ? "at rest" : NotAtRest;
  }
  std::ostringstream text;
  text << "at rest but for " << std::setprecision(2) << 100.0 * report.MovingShare << " %";
  return text.str();
}

void WarnOfNoRest(const SteadyStateCriterion& rest, const AdvanceReport& report, Warnings& messages)
{
  std::ostringstream text;
  if (report.IsSteady)
  {
    if (report.MovingShare > SteadyStateCriterion::FewMoving)
    {
      text << "A part of the skin, " << std::setprecision(2) << 100.0 * report.MovingShare
           << " %, does not settle: it oscillates (mean over the whole skin: "
           << report.MovingDistance << " voxels), usually because the target has edges or steps "
           << "that Tension smooths or the lattice cannot resolve. Use a distance or a smooth "
           << "image as target. Otherwise, over a mask, lower Tension; over distances with steps, "
           << "set TargetNoise to the size of the steps (needs Tension and NormalizeTarget).";
      messages.Say("no rest", text.str());
    }
    return;
  }
  text << "The skin has not reached a steady state after " << rest.MaximumSubsteps
       << (rest.MaximumSubsteps == 1 ? " substep" : " substeps") << ": its largest speed is "
       << report.SurfaceSpeed << " voxels per unit of motion time, and RestTolerance is "
       << rest.Tolerance;
  if (report.MovingShare > 0.0)
  {
    text << "; " << std::setprecision(2) << 100.0 * report.MovingShare
         << " % of the skin last moved by more than " << SteadyStateCriterion::Still << " voxels";
  }
  text << ". Raise MaximumNumberOfSubsteps, or RestTolerance.";
  messages.Say("no rest", text.str());
}

namespace
{

// Returns true if the settings differ only by the data of a static target.
bool AreDataReplaced(const SurfaceSettings& old, const SurfaceSettings& next)
{
  SurfaceSettings same = next;
  same.Inputs.TargetMTime = old.Inputs.TargetMTime;
  same.Inputs.InputSteps = old.Inputs.InputSteps;
  return old.UsesInput() && !old.Inputs.TargetMoves && !old.IsEquilibrium() &&
    old.Inputs.TargetMTime != 0 && next.Inputs.TargetMTime != 0 && same == old;
}

}

void RestartWarning::Note(
  const SurfaceSettings& old, const SurfaceSettings& next, bool hasBegun, PipelineTime requested)
{
  this->LastTime = hasBegun && AreDataReplaced(old, next) ? requested.Value : Never;
}

void RestartWarning::Report(PipelineTime requested, const Warnings& messages)
{
  if (requested.Value > this->LastTime && !this->IsReported)
  {
    this->IsReported = true;
    std::ostringstream text;
    text << "The input changed after the time " << this->LastTime
         << ", so the motion was restarted. Replacing or changing the input does not advance "
            "time: call Advance(frame, dt) for each frame, or connect a source that publishes "
            "TIME_STEPS (in Python: ParticleSeries).";
    messages.Say("replaced data", text.str());
  }
  this->LastTime = Never;
}

}
