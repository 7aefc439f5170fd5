#include "Implicit/LegendreStages.h"

namespace activesurface
{

namespace
{

LegendreStage StageOfFirstOrder(int j, double w)
{
  const double mu = (2.0 * j - 1.0) / j;
  return { mu, (1.0 - j) / j, mu * w, 0.0 };
}

double SecondOrderB(int j)
{
  return j < 3 ? 1.0 / 3.0 : (j * j + j - 2.0) / (2.0 * j * (j + 1.0));
}

LegendreStage StageOfSecondOrder(int j, double w)
{
  if (j == 1)
  {
    return { 0.0, 0.0, SecondOrderB(1) * w, 0.0 };
  }
  LegendreStage stage;
  stage.Mu = (2.0 * j - 1.0) / j * SecondOrderB(j) / SecondOrderB(j - 1);
  stage.Nu = -(j - 1.0) / j * SecondOrderB(j) / SecondOrderB(j - 2);
  stage.Rate = stage.Mu * w;
  stage.FirstRate = -(1.0 - SecondOrderB(j - 1)) * stage.Rate;
  return stage;
}

}

LegendreStages::LegendreStages(StageOrder order, int count)
  : Order(order)
{
  const double w = 1.0 / Reach(order, count);
  for (int j = 1; j <= count; ++j)
  {
    this->Stages.push_back(
      order == StageOrder::First ? StageOfFirstOrder(j, w) : StageOfSecondOrder(j, w));
  }
}

double LegendreStages::Damp(double decay) const
{
  double before = 1.0, now = 1.0 / (1.0 + this->Stages[0].Rate * decay);
  for (int j = 2; j <= this->GetNumberOfStages(); ++j)
  {
    const LegendreStage& stage = (*this)[j];
    const double next = (stage.Mu * now + stage.Nu * before + (1.0 - stage.Mu - stage.Nu)) /
      (1.0 + decay * stage.Rate);
    before = now;
    now = next;
  }
  return now;
}

double LegendreStages::Reach(StageOrder order, int count)
{
  const double s = count;
  return order == StageOrder::First ? .5 * (s * s + s) : .25 * (s * s + s - 2.0);
}

int LegendreStages::FindCount(StageOrder order, double eulerSteps)
{
  int count = order == StageOrder::First ? 1 : 3;
  while (Reach(order, count) < eulerSteps)
  {
    ++count;
  }
  return count;
}

}
