/**
 * Runge-Kutta-Legendre stages: s of them are as stable as about s^2 / 2 (first order) or s^2 / 4
 * (second order) forward Euler steps, for equations whose rates are real, as tension's are.
 *
 * C. D. Meyer, D. S. Balsara, T. D. Aslam, A stabilized Runge-Kutta-Legendre method for explicit
 * super-time-stepping of parabolic and mixed equations, J. Comput. Phys. 257 (2014). With the
 * equation y' = L(y), from y_0:
 *
 *   y_1 = y_0 + Rate_1 dt L(y_0)
 *   y_j = Mu_j y_(j-1) + Nu_j y_(j-2) + (1 - Mu_j - Nu_j) y_0 + Rate_j dt L(y_(j-1))
 *         + FirstRate_j dt L(y_0)
 */
#ifndef LegendreStages_h
#define LegendreStages_h

#include <vector>

namespace activesurface
{

enum class StageOrder
{
  First, //< monotone where forward Euler is; FirstRate is 0
  Second
};

struct LegendreStage
{
  double Mu = 0.0;
  double Nu = 0.0;
  double Rate = 0.0;
  double FirstRate = 0.0;
};

class LegendreStages
{
public:
  /** count: >= 1, of second order >= 3. */
  LegendreStages(StageOrder order, int count);

  int GetNumberOfStages() const { return static_cast<int>(this->Stages.size()); }
  StageOrder GetOrder() const { return this->Order; }
  /** The stage j, 1 to the number of stages. */
  const LegendreStage& operator[](int j) const { return this->Stages[j - 1]; }

  /** y after all stages of first order of y' = -decay y / dt, from 1, with y at the end of the
   * stage in place of y_(j-1) in L, which damps however large the decay. */
  double Damp(double decay) const;

  /** How many of the longest stable forward Euler steps the stages are as long as. */
  static double Reach(StageOrder order, int count);
  /** The least number of stages that reach so far. */
  static int FindCount(StageOrder order, double eulerSteps);

private:
  StageOrder Order;
  std::vector<LegendreStage> Stages;
};

}

#endif
