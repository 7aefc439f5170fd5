// What a user should know of a motion that has ended.

#ifndef MotionWarnings_h
#define MotionWarnings_h

#include "Motion.h"
#include "Warnings.h"

namespace activesurface
{

// That the skin has vanished, that the target was out of reach of one that EXACT holds, and that
// the target was not finite; time: the motion's.
void WarnOfMotion(const AdvanceReport& report, double time, Warnings& messages);

// That the substeps were used up before the skin was at rest; speed: the last one.
void WarnOfNoRest(const RestCriterion& rest, double speed, Warnings& messages);

}

#endif
