// Durations of the stages of the node scheme: no wave on a flat surface grows, for any tension.

#include "Nodes/StagePlan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

using namespace activesurface;

namespace TestStagePlan
{

namespace
{

constexpr double Pi = 3.14159265358979323846;
using Vector = std::array<double, 3>;

// Returns g / b (see StagePlan.h) of a wave exp(i k x) on the plane with the normal n, by
// differences over 2 S nodes.
double FactorOf(const Vector& k, const Vector& n, double S)
{
  const auto second = [&](int i) { return -4.0 * std::pow(std::sin(0.5 * S * k[i]) / S, 2); };
  const auto mixed = [&](int i, int j)
  { return -std::sin(S * k[i]) * std::sin(S * k[j]) / (S * S); };
  const double xx = second(0), yy = second(1), zz = second(2);
  return 2.0 * (n[0] * n[1] * mixed(0, 1) + n[0] * n[2] * mixed(0, 2) + n[1] * n[2] * mixed(1, 2)) -
    n[0] * n[0] * (yy + zz) - n[1] * n[1] * (xx + zz) - n[2] * n[2] * (xx + yy);
}

// Calls visit(fine, coarse) with g / b by differences over 2 and 4 nodes, for waves and normals in
// steps of a sixteenth of pi.
template <class Visitor>
void ForEachWave(Visitor&& visit)
{
  constexpr int steps = 16;
  for (int tilt = 0; tilt <= steps / 2; ++tilt)
  {
    for (int turn = 0; turn <= steps / 2; ++turn)
    {
      const double a = tilt * Pi / steps, b = turn * Pi / steps;
      const Vector normal = { std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a) };
      for (int n = 0; n < (steps + 1) * 2 * steps * 2 * steps; ++n)
      {
        const Vector wave = { Pi * (n / (4 * steps * steps)) / steps,
          Pi * (n / (2 * steps) % (2 * steps) - steps) / steps,
          Pi * (n % (2 * steps) - steps) / steps };
        visit(FactorOf(wave, normal, 1.0), FactorOf(wave, normal, 2.0));
      }
    }
  }
}

// Values of b. The automatic b is 3, 12 and 48 for voxels of r, r / 2 and r / 4, with r the radius
// of a particle.
const std::vector<float> Tensions = { 0.f, 1e-3f, .5f, 3.f, 6.f, 7.9f, 12.f, 12.7f, 48.f, 1e3f };

// Factor by which the stages from `first` to before `last` multiply a wave, with g as in
// StagePlan.h and the attraction a.
double MultiplyWave(const StagePlan& plan, int first, int last, double g, double a)
{
  double size = 1.0;
  for (int i = first; i < last; ++i)
  {
    const double share = plan.GetShare(i), x = a * share;
    size *= std::exp(-x) - share * g * (x > 0.0 ? -std::expm1(-x) / x : 1.0);
  }
  return std::fabs(size);
}

double SumOfShares(const StagePlan& plan)
{
  double sum = 0.0;
  for (int i = 0; i < plan.Count; ++i)
  {
    sum += plan.GetShare(i);
  }
  return sum;
}

double LargestFactor(const StagePlan& plan, float tension)
{
  return tension > 0.f ? double(GreatestFactor(plan.Fine / tension)) * tension : 0.0;
}

}

TEST(TestStagePlan, NoWaveExceedsTheGreatestFactor)
{
  std::array<double, 6> greatest{};
  constexpr std::array<double, 6> fractions = { 1.0 / 6.0, 0.25, 0.4, 0.6, 0.8, 1.0 };
  ForEachWave(
    [&](double fine, double coarse)
    {
      for (std::size_t i = 0; i < fractions.size(); ++i)
      {
        greatest[i] = std::max(greatest[i], fractions[i] * fine + (1.0 - fractions[i]) * coarse);
      }
    });
  for (std::size_t i = 0; i < fractions.size(); ++i)
  {
    const double bound = double(GreatestFactor(static_cast<float>(fractions[i])));
    EXPECT_LE(greatest[i], bound + 1e-3) << fractions[i];
    EXPECT_GE(greatest[i], 0.85 * bound) << fractions[i];
  }
}

TEST(TestStagePlan, CyclesDampAllWaves)
{
  for (const float tension : Tensions)
  {
    const StagePlan plan = PlanCycles(tension);
    const int count = plan.Count;
    EXPECT_NEAR(SumOfShares(plan), 1.0, 1e-4);
    EXPECT_GE(count, 5);
    EXPECT_GE(plan.Fine, tension / 6.001f);
    EXPECT_LE(plan.Fine, tension);
    for (int n = 0; n <= 400; ++n)
    {
      const double g = LargestFactor(plan, tension) * n / 400;
      const std::string wave = std::to_string(tension) + ", g " + std::to_string(g);
      EXPECT_LE(MultiplyWave(plan, 0, count, g, 0.0), std::max(0.101, std::exp(-g) + 1e-6)) << wave;
      for (int i = 0; i <= count; ++i)
      {
        EXPECT_LE(MultiplyWave(plan, 0, i, g, 0.0), 1.201) << wave;
        EXPECT_LE(MultiplyWave(plan, 0, i, g, 6.0), 1.201) << wave;
      }
      EXPECT_LE(MultiplyWave(plan, 0, count, g, 6.0), 0.3) << wave;
    }
  }
}

TEST(TestStagePlan, ErrorsGrowLittleWithinACycle)
{
  for (const float tension : { 3.f, 7.9f, 12.f }) // cycles of five, six and seven stages
  {
    const StagePlan plan = PlanCycles(tension);
    for (int n = 0; n <= 400; ++n)
    {
      const double g = LargestFactor(plan, tension) * n / 400;
      for (int i = 0; i < plan.Count; ++i)
      {
        EXPECT_LE(MultiplyWave(plan, i, plan.Count, g, 0.0), 8.3) << tension;
      }
    }
  }
}

TEST(TestStagePlan, MoreTensionNeedsFewMoreStages)
{
  EXPECT_EQ(PlanCycles(0.f).Count, 5);
  EXPECT_EQ(PlanCycles(3.f).Count, 5);
  EXPECT_EQ(PlanCycles(7.9f).Count, 6);
  EXPECT_EQ(PlanCycles(12.f).Count, 7);
  EXPECT_EQ(PlanCycles(48.f).Count, 28);
  EXPECT_LT(PlanCycles(MostStageTension).Count, 600000);
}

TEST(TestStagePlan, EqualStagesAreStable)
{
  for (const float tension : Tensions)
  {
    const StagePlan plan = PlanEqualStages(tension);
    EXPECT_NEAR(SumOfShares(plan), 1.0, 1e-4);
    EXPECT_LE(LargestFactor(plan, tension) * double(plan.GetShare(0)), 1.66) << tension;
  }
}

}
