// The stages that make the tension of an implicit substep: order, damping, and how far they reach.

#include "Implicit/LegendreStages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

using namespace activesurface;

namespace TestLegendreStages
{
// y after all stages of y' = -decay y / dt, from 1.
double Amplify(const LegendreStages& stages, double decay)
{
  double before = 1.0, now = 1.0 - stages[1].Rate * decay;
  for (int j = 2; j <= stages.GetNumberOfStages(); ++j)
  {
    const LegendreStage& stage = stages[j];
    const double next = stage.Mu * now + stage.Nu * before + (1.0 - stage.Mu - stage.Nu) -
      decay * (stage.Rate * now + stage.FirstRate);
    before = now;
    now = next;
  }
  return now;
}

// y' = -y over one step: of order p the error falls by 2^(p+1) where the step is halved; a tenth is
// left for the next order.
TEST(TestLegendreStages, HaveTheirOrder)
{
  for (const auto& [order, power] : { std::pair(StageOrder::First, 1), { StageOrder::Second, 2 } })
  {
    for (int count = 3; count <= 6; ++count)
    {
      const LegendreStages stages(order, count);
      const double step = .02;
      const auto error = [&](double decay) { return Amplify(stages, decay) - std::exp(-decay); };
      const double ratio = error(step) / error(.5 * step);
      EXPECT_NEAR(ratio / std::pow(2.0, power + 1), 1.0, .1) << count << " stages, order " << power;
    }
  }
}

// Taken at the end of each stage, of first order too; and nothing swings far beyond 0, however
// strong: the more stages the farther, by computation .029 for two to .16 for six.
TEST(TestLegendreStages, DampWithoutSwinging)
{
  for (int count = 2; count <= 6; ++count)
  {
    const LegendreStages stages(StageOrder::First, count);
    const auto error = [&](double decay) { return stages.Damp(decay) - std::exp(-decay); };
    EXPECT_NEAR(error(.02) / error(.01), 4.0, .4) << count << " stages";
    for (double decay = 0.0; decay <= 50.0; decay += .05)
    {
      EXPECT_LE(stages.Damp(decay), 1.0 + 1e-12) << count << " stages, decay " << decay;
      EXPECT_GE(stages.Damp(decay), count == 2 ? -.03 : -.16)
        << count << " stages, decay " << decay;
    }
  }
  EXPECT_NEAR(LegendreStages(StageOrder::First, 3).Damp(1.0), std::exp(-1.0), .005);
}

// Forward Euler is stable to a decay of 2; and no stages reach farther than they say.
TEST(TestLegendreStages, AreStableAsFarAsTheyReach)
{
  for (const StageOrder order : { StageOrder::First, StageOrder::Second })
  {
    for (int count = 3; count <= 8; ++count)
    {
      const LegendreStages stages(order, count);
      const double reach = LegendreStages::Reach(order, count);
      double largest = 0.0;
      for (double decay = 0.0; decay <= 2.0 * reach; decay += .01)
      {
        largest = std::max(largest, std::fabs(Amplify(stages, decay)));
      }
      EXPECT_LE(largest, 1.0 + 1e-12) << count << " stages";
      if (order == StageOrder::First) // the second order leaves more room
      {
        EXPECT_GT(std::fabs(Amplify(stages, 2.2 * reach)), 1.0) << count << ", a tenth farther";
      }
      EXPECT_EQ(LegendreStages::FindCount(order, reach), count) << "stages that reach so far";
    }
  }
}
}
