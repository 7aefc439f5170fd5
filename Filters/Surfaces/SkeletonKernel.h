// What one element of a skeleton adds to the sum: strength * W(distance / radius), and its
// gradient.
//
// W is compact: W(0) = 1, W(q >= 1) = 0, and W' is continuous and vanishes at both ends. A kernel
// gives W(q) and W'(q)/q, which unlike W' needs no direction where the distance is zero, from q^2.

#ifndef SkeletonKernel_h
#define SkeletonKernel_h

#include "InstructionSets.h"

#include <cmath>

namespace activesurface
{

enum class SkeletonKernel
{
  Wyvill,
  CubicSpline,
  Metaball
};

struct KernelSample
{
  double Value;      // W(q)
  double SlopeOverQ; // W'(q) / q
};

// Wyvill, McPheeters and Wyvill 1986, in its sextic form.
struct WyvillKernel
{
  static ACTIVE_ALWAYS_INLINE KernelSample At(double q2)
  {
    const double u = 1.0 - q2;
    return { u * u * u, -6.0 * (u * u) };
  }
};

// The cubic B-spline of SPH, scaled to W(0) = 1 and support 1.
struct CubicSplineKernel
{
  static ACTIVE_ALWAYS_INLINE KernelSample At(double q2)
  {
    const double q = std::sqrt(q2);
    if (q <= 0.5)
    {
      return { 1.0 - 6.0 * q2 * (1.0 - q), 18.0 * q - 12.0 };
    }
    const double v = 1.0 - q;
    return { 2.0 * (v * v * v), -6.0 * (v * v) / q };
  }
};

// Nishimura's piecewise quadratic.
struct MetaballKernel
{
  static ACTIVE_ALWAYS_INLINE KernelSample At(double q2)
  {
    if (9.0 * q2 <= 1.0)
    {
      return { 1.0 - 3.0 * q2, -6.0 };
    }
    const double q = std::sqrt(q2);
    const double v = 1.0 - q;
    return { 1.5 * (v * v), -3.0 * v / q };
  }
};

// Sums of contributions: 0, 1, 2 are MINUS the gradient, as wanted of a potential that is negative
// inside, 3 is the value. One array, because compilers then add two at a time.
struct SkeletonSum
{
  double Terms[4] = { 0.0, 0.0, 0.0, 0.0 };
};

struct SkeletonPoint
{
  double Position[3];
  double Strength;
  double InverseRadius2;

  template <class Kernel>
  ACTIVE_ALWAYS_INLINE void AddTo(SkeletonSum& sum, const double x[3]) const
  {
    const double offset[4] = { this->Position[0] - x[0], this->Position[1] - x[1],
      this->Position[2] - x[2], this->Strength };
    const double q2 = (offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2]) *
      this->InverseRadius2;
    if (!(q2 < 1.0))
    {
      return;
    }
    const KernelSample kernel = Kernel::At(q2);
    const double rate = this->Strength * kernel.SlopeOverQ * this->InverseRadius2;
    const double factors[4] = { rate, rate, rate, kernel.Value };
    for (int i = 0; i < 4; ++i)
    {
      sum.Terms[i] += offset[i] * factors[i];
    }
  }
};

// Radius and strength run linearly from start to end and are taken at the point of the segment that
// is closest to x, at the fraction t of its length.
struct SkeletonSegment
{
  double Start[3];
  double Edge[3];
  double InverseLength2; // 0 for a segment without length, which then acts as its start point
  double Radius;
  double RadiusChange;
  double Strength;
  double StrengthChange;

  template <class Kernel>
  ACTIVE_ALWAYS_INLINE void AddTo(SkeletonSum& sum, const double x[3]) const
  {
    double offset[3] = { this->Start[0] - x[0], this->Start[1] - x[1], this->Start[2] - x[2] };
    const double along =
      -(offset[0] * this->Edge[0] + offset[1] * this->Edge[1] + offset[2] * this->Edge[2]);
    const double t = std::fmin(std::fmax(along * this->InverseLength2, 0.0), 1.0);
    for (int axis = 0; axis < 3; ++axis)
    {
      offset[axis] += t * this->Edge[axis];
    }
    const double inverseRadius = 1.0 / (this->Radius + t * this->RadiusChange);
    const double q2 = (offset[0] * offset[0] + offset[1] * offset[1] + offset[2] * offset[2]) *
      (inverseRadius * inverseRadius);
    if (!(q2 < 1.0))
    {
      return;
    }
    const double strength = this->Strength + t * this->StrengthChange;
    const KernelSample kernel = Kernel::At(q2);
    const double slope = strength * kernel.SlopeOverQ;
    // Between the ends t depends on x; the distance does not depend on t, being least there.
    const double perLength = t > 0.0 && t < 1.0 ? this->InverseLength2 : 0.0;
    const double alongEdge = perLength *
      (slope * q2 * this->RadiusChange * inverseRadius - this->StrengthChange * kernel.Value);
    const double rate = slope * (inverseRadius * inverseRadius);
    for (int axis = 0; axis < 3; ++axis)
    {
      sum.Terms[axis] += rate * offset[axis] + alongEdge * this->Edge[axis];
    }
    sum.Terms[3] += strength * kernel.Value;
  }
};

}

#endif
