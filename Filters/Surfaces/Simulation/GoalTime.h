// Where a time is among the steps.

#ifndef GoalTime_h
#define GoalTime_h

#include <vector>

namespace activesurface
{

struct GoalTime
{
  int Step = 0;         // the last one that is not after the time
  double Time = 0.0;    // pipeline time
  bool Between = false; // after that step
};

// A time before the first step is the first, after the last the last one, and a millionth of their
// distance from a step is that step. There has to be a step.
GoalTime FindGoal(const std::vector<double>& steps, double pipelineTime);

}

#endif
