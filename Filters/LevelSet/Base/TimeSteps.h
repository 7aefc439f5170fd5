/**
 * Selection of a step in a list of times.
 */
#ifndef TimeSteps_h
#define TimeSteps_h

#include "ActiveLevelSetExport.h"

#include <vector>

namespace activesurface
{

struct StepOfTime
{
  int Step = 0;         //< index of the step; if Between, of the last step before the time
  double Time = 0.0;    //< time of the step, or the requested time if Between
  bool Between = false; //< the requested time is after Step and before the next step
};

/**
 * Finds the step of a time. steps: ascending, at least one. A time before the first step gives the
 * first step, a time after the last step gives the last step. A time that differs from a step by at
 * most a millionth of the interval that contains the time gives this step, so that rounding (0.1 +
 * 0.2 for 0.3) does not select another step.
 */
ACTIVELEVELSET_EXPORT StepOfTime FindStep(const std::vector<double>& steps, double time);

}

#endif
