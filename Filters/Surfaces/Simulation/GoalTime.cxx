#include "Simulation/GoalTime.h"

#include <algorithm>

namespace activesurface
{

namespace
{

// A time that is so near a step, in units of the distance to the next one, is that step.
constexpr double RoundingOfTimes = 1e-6;

}

GoalTime FindGoal(const std::vector<double>& steps, double pipelineTime)
{
  const double time = pipelineTime > steps.front() ? pipelineTime : steps.front();
  const auto after = std::upper_bound(steps.begin(), steps.end(), time);
  GoalTime goal;
  goal.Step = std::max(0, static_cast<int>(after - steps.begin()) - 1);
  goal.Time = steps[goal.Step];
  if (after == steps.end())
  {
    return goal;
  }
  const double tolerance = RoundingOfTimes * (*after - goal.Time);
  if (*after - time <= tolerance)
  {
    ++goal.Step;
    goal.Time = *after;
  }
  else if (time - goal.Time > tolerance)
  {
    goal.Time = time;
    goal.Between = true;
  }
  return goal;
}

}
