// What a user should know of a motion that has ended.

#ifndef MotionWarnings_h
#define MotionWarnings_h

#include "Motion.h"
#include "Simulation/Times.h"
#include "Simulation/Warnings.h"

namespace activesurface
{

struct MotionEnd
{
  MotionTime Time;
  bool WasEmpty;    // already before
  bool MayComeBack; // a skin that has vanished
};

// That the skin has vanished, that the target was out of reach of one that EXACT holds, and that
// the target was not finite.
void WarnOfMotion(const AdvanceReport& report, const MotionEnd& end, Warnings& messages);

struct Outside
{
  PipelineTime Time;
  double Share;          // of the target
  const Motion& Law;     // that the skin moved by
  bool ParticlesAreLost; // else parts of a volume
};

// That more than a hundredth of the target is outside the skin.
void WarnOfOutside(const Outside& outside, Warnings& messages);

/** Event of the history, where the way to rest has ended before. */
constexpr const char* NotAtRest = "not at rest";

/** Returns the event of the history: steady, oscillating in a share of the skin, or neither. */
std::string DescribeRest(const AdvanceReport& report);

// Warns if the substeps ended before a steady state, or if a part of the skin oscillates.
void WarnOfNoRest(
  const SteadyStateCriterion& rest, const AdvanceReport& report, Warnings& messages);

}

#endif
