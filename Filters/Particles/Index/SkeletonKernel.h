// Contributions of one element of a skeleton: to the sum, strength * W(distance / radius), and to
// the gradient of the potential (threshold - sum).
//
// W is compact: W(0) = 1, W(q >= 1) = 0, and W' is continuous and vanishes at both ends. A kernel
// returns W(q) and W'(q)/q as functions of q^2 <= 1. The gradient for a point is strength * W'(q)/q
// * offset / radius^2 (offset: from the position to the point), which is finite at distance 0.

#ifndef SkeletonKernel_h
#define SkeletonKernel_h

#include "Base/InstructionSets.h"

#include <algorithm>
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

// Selects component by component, without a branch.
ACTIVE_ALWAYS_INLINE KernelSample Choose(
  bool first, const KernelSample& one, const KernelSample& other)
{
  return { first ? one.Value : other.Value, first ? one.SlopeOverQ : other.SlopeOverQ };
}

// After Wyvill, McPheeters and Wyvill 1986.
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
    const double v = 1.0 - q;
    const KernelSample near = { 1.0 - 6.0 * q2 * v, 18.0 * q - 12.0 };
    const KernelSample far = { 2.0 * (v * v * v), -6.0 * (v * v) / q };
    return Choose(q <= 0.5, near, far);
  }
};

// Nishimura's piecewise quadratic.
struct MetaballKernel
{
  static ACTIVE_ALWAYS_INLINE KernelSample At(double q2)
  {
    const double q = std::sqrt(q2);
    const double v = 1.0 - q;
    const KernelSample near = { 1.0 - 3.0 * q2, -6.0 };
    const KernelSample far = { 1.5 * (v * v), -3.0 * v / q };
    return Choose(9.0 * q2 <= 1.0, near, far);
  }
};

// A position and the sums of the contributions at this position. Terms 0, 1, 2 are the gradient of
// the potential (threshold - sum). Term 3 is the sum. In one array, compilers vectorise the sums by
// pairs of terms.
struct SkeletonPlace
{
  double X[3];
  double Terms[4] = { 0.0, 0.0, 0.0, 0.0 };
};

// Positions in SIMD lanes.
struct SkeletonLanes
{
  static constexpr int Width = 8;
  double X[3][Width];
  double Terms[4][Width] = {};
};

struct SkeletonPoint
{
  double Position[3];
  double Strength;
  double InverseRadius2;

  template <class Kernel>
  ACTIVE_ALWAYS_INLINE void AddTo(SkeletonPlace& place) const
  {
    const double offset[4] = { this->Position[0] - place.X[0], this->Position[1] - place.X[1],
      this->Position[2] - place.X[2], this->Strength };
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
      place.Terms[i] += offset[i] * factors[i];
    }
  }

  // Bitwise identical to the function for one position: beyond the support, W(1) = W'(1) = 0 adds
  // zeros.
  template <class Kernel>
  ACTIVE_ALWAYS_INLINE void AddTo(SkeletonLanes& lanes) const
  {
    for (int i = 0; i < SkeletonLanes::Width; ++i)
    {
      const double x = this->Position[0] - lanes.X[0][i];
      const double y = this->Position[1] - lanes.X[1][i];
      const double z = this->Position[2] - lanes.X[2][i];
      const double q2 = std::min((x * x + y * y + z * z) * this->InverseRadius2, 1.0);
      const KernelSample kernel = Kernel::At(q2);
      const double rate = this->Strength * kernel.SlopeOverQ * this->InverseRadius2;
      lanes.Terms[0][i] += x * rate;
      lanes.Terms[1][i] += y * rate;
      lanes.Terms[2][i] += z * rate;
      lanes.Terms[3][i] += this->Strength * kernel.Value;
    }
  }
};

// A segment whose radius and strength are linear from start to end. At x, the radius and the
// strength are those of the closest point of the segment, at the fraction t of its length.
struct SkeletonSegment
{
  double Start[3];
  double Edge[3];
  double InverseLength2; // 0 for a segment of zero length, which acts as its start point
  double Radius;
  double RadiusChange;
  double Strength;
  double StrengthChange;

  template <class Kernel>
  ACTIVE_ALWAYS_INLINE void AddTo(SkeletonPlace& place) const
  {
    double offset[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      offset[axis] = this->Start[axis] - place.X[axis];
    }
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
    // Between the ends of the segment, t depends on x, but the derivative of the distance with
    // respect to t is zero.
    const double perLength = t > 0.0 && t < 1.0 ? this->InverseLength2 : 0.0;
    const double alongEdge = perLength *
      (slope * q2 * this->RadiusChange * inverseRadius - this->StrengthChange * kernel.Value);
    const double rate = slope * (inverseRadius * inverseRadius);
    for (int axis = 0; axis < 3; ++axis)
    {
      place.Terms[axis] += rate * offset[axis] + alongEdge * this->Edge[axis];
    }
    place.Terms[3] += strength * kernel.Value;
  }

  template <class Kernel>
  ACTIVE_ALWAYS_INLINE void AddTo(SkeletonLanes& lanes) const
  {
    for (int i = 0; i < SkeletonLanes::Width; ++i)
    {
      SkeletonPlace place{ { lanes.X[0][i], lanes.X[1][i], lanes.X[2][i] },
        { lanes.Terms[0][i], lanes.Terms[1][i], lanes.Terms[2][i], lanes.Terms[3][i] } };
      this->AddTo<Kernel>(place);
      for (int term = 0; term < 4; ++term)
      {
        lanes.Terms[term][i] = place.Terms[term];
      }
    }
  }
};

}

#endif
