#include "Targets/PotentialTarget.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace activesurface
{

namespace
{

// Fraction of Attraction that acts on noise. With the automatic attraction (a factor e^6 per time
// step), noise decreases by a sixth per time step.
constexpr double SlowShare = 0.03;

}

PotentialTarget::PotentialTarget(const TargetOptions& options)
  : Options(options)
{
}

double PotentialTarget::Side(double value) const
{
  const double above = value - this->Options.IsoValue;
  return this->Options.Invert ? -above : above;
}

void PotentialTarget::TurnIntoDistance(double length, double& value, double& slope) const
{
  const double reach = this->Options.Reach;
  const double distance = std::isfinite(length) && length > 0.0 ? value / length : HUGE_VAL * value;
  if (std::fabs(distance) < reach)
  {
    value = distance;
    slope = 1.0;
    return;
  }
  value = value == 0.0 || std::isnan(value) ? value : std::copysign(reach, value);
  slope = 0.0;
}

// Replaces F by F s(F / Noise), where s is a smooth step from SlowShare to 1.
void PotentialTarget::FollowNoiseSlowly(double& value, double& slope) const
{
  if (slope == 0.0)
  {
    return;
  }
  const double square = (value / this->Options.Noise) * (value / this->Options.Noise);
  const double step = square * square / (1.0 + square * square);
  value *= SlowShare + (1.0 - SlowShare) * step;
  slope = SlowShare + (1.0 - SlowShare) * (step + 4.0 * step / (1.0 + square * square));
}

void PotentialTarget::Evaluate(
  std::size_t count, const double* points, const TargetResults& results) const
{
  constexpr std::size_t batch = 128;
  double gradients[3 * batch];
  const bool hasNoise = this->Options.Normalize && this->Options.Noise > 0.0;
  for (std::size_t first = 0; first < count; first += batch)
  {
    const std::size_t size = std::min(batch, count - first);
    this->Sample(size, points + 3 * first, results.Values + first, gradients);
    for (std::size_t i = 0; i < size; ++i)
    {
      const double* g = gradients + 3 * i;
      double& value = results.Values[first + i];
      double& slope = results.Slopes[first + i];
      value = this->Side(value);
      slope = std::sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
      if (this->Options.Normalize)
      {
        this->TurnIntoDistance(slope, value, slope);
        if (hasNoise)
        {
          this->FollowNoiseSlowly(value, slope);
        }
      }
      else if (!std::isfinite(slope))
      {
        value = std::nan(""); // no time step would be stable, so the sample is dropped
      }
    }
  }
}

void PotentialTarget::EvaluateLevel(std::size_t count, const double* points, double* values) const
{
  this->Sample(count, points, values, nullptr);
  std::transform(
    values, values + count, values, [this](double value) { return this->Side(value); });
}

void PotentialTarget::EvaluateLevel(
  std::size_t count, const double* points, double* values, double* slopes) const
{
  std::vector<double> gradients(3 * count);
  this->Sample(count, points, values, gradients.data());
  for (std::size_t i = 0; i < count; ++i)
  {
    const double* g = gradients.data() + 3 * i;
    const double slope = std::sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
    slopes[i] = std::isfinite(slope) && slope > 0.0 ? slope : 1.0;
    values[i] = this->Side(values[i]);
  }
}

}
