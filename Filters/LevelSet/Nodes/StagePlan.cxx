#include "Nodes/StagePlan.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace activesurface
{

namespace
{

constexpr float LeastFine = 1.f / 6.f; // of the tension

/** n durations 1 / (1 + v - (1 - v) cos((2 j - 1) pi / (2 n))), j = 1 to n, in units of the longest
 * stable duration of a single stage, 2 / gmax; gmax: g (GreatestFactor) of the wave that decays
 * fastest. A cycle multiplies waves with g >= v gmax by at most 0.1. Among the orders that keep all
 * waves below 1.2 times their size, errors grow least in this order. */
struct Cycle
{
  int Count;
  float Sum;
  float Durations[7];
};

constexpr Cycle Cycles[] = {
  { 5, 8.557f, { .5115f, 1.8302f, .9221f, 4.6770f, .6163f } },
  { 6, 12.214f, { .7674f, .5798f, 6.6011f, .5081f, 2.5326f, 1.2249f } },
  { 7, 16.536f, { .5061f, 3.3648f, .9575f, 1.5880f, .5582f, 8.8757f, .6854f } },
};

/** Returns ceil(a / b), at least 1. */
int CountOf(float a, float b)
{
  return std::max(1, static_cast<int>(std::ceil(a / b)));
}

}

StagePlan PlanCycles(float tension)
{
  const float needed = .5f * GreatestFactor(LeastFine) * tension;
  const int count = CountOf(needed, std::end(Cycles)[-1].Sum);
  const Cycle& cycle = *std::find_if(std::begin(Cycles), std::end(Cycles) - 1,
    [&](const Cycle& one) { return one.Sum * static_cast<float>(count) >= needed; });
  const float sum = cycle.Sum * static_cast<float>(count);
  // f * tension, where the fraction f solves GreatestFactor(f) * tension = 2 * sum.
  const float stable =
    (2.f * sum - GreatestFactor(0.f) * tension) / (GreatestFactor(1.f) - GreatestFactor(0.f));
  const float fine = std::min(std::max(stable, LeastFine * tension), tension);
  return { count * cycle.Count, fine, cycle.Durations, cycle.Count, sum };
}

StagePlan PlanEqualStages(float tension)
{
  constexpr float mostOfFine = .15f, mostOfOther = .6f; // tension of a stage
  constexpr float fineStages = 64.f;
  static constexpr float equal = 1.f;
  const bool isFine = tension <= mostOfFine * fineStages;
  const int count = CountOf(tension, isFine ? mostOfFine : mostOfOther);
  return { count, isFine ? tension : LeastFine * tension, &equal, 1, static_cast<float>(count) };
}

}
