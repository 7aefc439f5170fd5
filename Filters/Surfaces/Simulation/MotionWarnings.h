// Warnings about completed and restarted motions, and the event of a motion in the history.

#ifndef MotionWarnings_h
#define MotionWarnings_h

#include "Base/Motion.h"
#include "Simulation/SurfaceSettings.h"
#include "Simulation/Times.h"
#include "Targets/Warnings.h"

#include <limits>

namespace activesurface
{

// Warns if the motion restarts because the input's data were replaced between requests for two
// ascending times. A loop that replaces the data to animate the skin does this.
class RestartWarning
{
public:
  // Detects replaced data; call this before the settings change. requested: last requested time.
  void Note(
    const SurfaceSettings& old, const SurfaceSettings& next, bool hasBegun, PipelineTime requested);

  // Has to be called with each requested time. Warns once at most.
  void Report(PipelineTime requested, const Warnings& messages);

private:
  static constexpr double Never = std::numeric_limits<double>::infinity();

  double LastTime = Never; // last time requested before the data were replaced
  bool IsReported = false;
};

struct MotionEnd
{
  MotionTime Time;
  bool WasEmpty;    // before the motion
  bool MayComeBack; // a vanished skin may be created again
};

// Warns if the skin has vanished, if an EXACT control cancelled the whole attraction, or if the
// target was not finite at some points.
void WarnOfMotion(const AdvanceReport& report, const MotionEnd& end, Warnings& messages);

struct Outside
{
  PipelineTime Time;
  double Share;             // fraction of the target outside the skin
  const Motion& Parameters; // parameters by which the skin moved
  bool ParticlesAreLost;    // Share is of particles; otherwise of a skeleton's points or the inside
};

// Warns if more than 1 % of the target is outside the skin.
void WarnOfOutside(const Outside& outside, Warnings& messages);

/** Event of the history if MaximumSubsteps was reached before a steady state. */
constexpr const char* NotAtRest = "not at rest";

/** Returns the event: steady, steady except for an oscillating fraction, or NotAtRest. */
std::string DescribeRest(const AdvanceReport& report);

// Warns if the substeps ended before a steady state, or if more than FewMoving of the skin
// oscillates.
void WarnOfNoRest(
  const SteadyStateCriterion& rest, const AdvanceReport& report, Warnings& messages);

}

#endif
