/**
 * Which step of a list of times is meant by a time.
 */
#ifndef TimeSteps_h
#define TimeSteps_h

#include "ActiveNarrowBandExport.h"

#include <vector>

namespace activesurface
{

struct StepOfTime
{
  int Step = 0;         //< the last one that is not after the time
  double Time = 0.0;    //< that of the step, or the time asked for if it is between two steps
  bool Between = false; //< after that step and before the next one
};

/**
 * steps: ascending, at least one. A time before the first step is the first step, after the last
 * one the last step; nearer to a step than a millionth of the interval is that step, so that
 * rounding (.1 + .2 for .3) does not miss it.
 */
ACTIVENARROWBAND_EXPORT StepOfTime FindStep(const std::vector<double>& steps, double time);

}

#endif
