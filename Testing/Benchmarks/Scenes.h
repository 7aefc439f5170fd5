/**
 * Targets of the benchmarks: distances by formula, evaluated without a virtual call per point.
 */
#ifndef Scenes_h
#define Scenes_h

#include "Support/UnitBox.h"

#include "NarrowBand.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace activesurface
{

struct BallDistance
{
  double Radius = 0.6;
  double X = 0.0;

  double operator()(const double* at) const
  {
    const double x = at[0] - this->X;
    return std::sqrt(x * x + at[1] * at[1] + at[2] * at[2]) - this->Radius;
  }
};

/** Distance to a torus around the z axis. */
struct TorusDistance
{
  double RingRadius = 0.0;
  double TubeRadius = 0.0;

  double operator()(const double* at) const
  {
    const double ring = std::sqrt(at[0] * at[0] + at[1] * at[1]) - this->RingRadius;
    return std::sqrt(ring * ring + at[2] * at[2]) - this->TubeRadius;
  }
};

/** Ten equal balls in a row as long as Box, along x. Y displaces the first `Moving` balls. */
struct RowOfBalls
{
  static constexpr int Count = 10;
  int Moving = 0;
  double Y = 0.0;

  double operator()(const double* at) const
  {
    constexpr double pitch = 2.0 / Count;
    const int number = std::clamp(static_cast<int>((at[0] + 1.0) / pitch), 0, Count - 1);
    const double x = at[0] + 1.0 - (number + 0.5) * pitch;
    const double y = at[1] - (number < this->Moving ? this->Y : 0.0);
    return std::sqrt(x * x + y * y + at[2] * at[2]) - 0.4 * pitch;
  }
};

template <class Distance>
InitialFunction MakeInitial(const Distance& distance)
{
  InitialFunction initial;
  initial.Evaluate = [distance](std::size_t count, const double* points, double* values)
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      values[i] = distance(points + 3 * i);
    }
  };
  return initial;
}

template <class Distance>
class FormulaTarget : public Target
{
public:
  explicit FormulaTarget(const Distance& distance)
    : Form(distance)
  {
  }

  void Evaluate(
    std::size_t count, const double* points, const TargetResults& results) const override
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      results.Values[i] = this->Form(points + 3 * i);
      results.Slopes[i] = 1.0;
    }
  }

protected:
  Distance Form;
};

/** A ball that oscillates along x, so that leaves do not converge. */
class MovingBall : public FormulaTarget<BallDistance>
{
public:
  MovingBall()
    : FormulaTarget<BallDistance>(BallDistance())
  {
  }
  void MoveTo(double time) override { this->Form.X = 0.1 * std::sin(3.0 * time); }
};

inline AdvanceReport AdvanceSubsteps(
  NarrowBand& band, int substeps, const Motion& motion, Target& target)
{
  int asked = 0;
  return band.Advance(
    band.GetTime() + 1.0, motion, target, [&](double) { return asked++ < substeps; });
}

}

#endif
