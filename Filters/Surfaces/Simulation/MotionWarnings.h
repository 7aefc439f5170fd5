// What a user should know of a motion that has ended.

#ifndef MotionWarnings_h
#define MotionWarnings_h

#include "Motion.h"
#include "Simulation/Warnings.h"

namespace activesurface
{

// That the skin has vanished, and that the target was not finite; time: the motion's.
void WarnOfMotion(const AdvanceReport& report, double time, Warnings& messages);

// That the substeps were used up before the skin was at rest; speed: the last one.
void WarnOfNoRest(const SteadyStateCriterion& rest, double speed, Warnings& messages);

}

#endif
