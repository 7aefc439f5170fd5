#include "Base/TimeSteps.h"

#include <algorithm>

namespace activesurface
{

namespace
{

/** Tolerance of times, relative to the interval between two steps. */
constexpr double RoundingOfTimes = 1e-6;

}

StepOfTime FindStep(const std::vector<double>& steps, double requested)
{
  const double time = requested > steps.front() ? requested : steps.front();
  const auto after = std::upper_bound(steps.begin(), steps.end(), time);
  StepOfTime found;
  found.Step = std::max(0, static_cast<int>(after - steps.begin()) - 1);
  found.Time = steps[found.Step];
  if (after == steps.end())
  {
    return found;
  }
  const double tolerance = RoundingOfTimes * (*after - found.Time);
  if (*after - time <= tolerance)
  {
    ++found.Step;
    found.Time = *after;
  }
  else if (time - found.Time > tolerance)
  {
    found.Time = time;
    found.Between = true;
  }
  return found;
}

}
