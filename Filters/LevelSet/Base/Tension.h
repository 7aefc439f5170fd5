/**
 * The tension term, -Tension kappa: its kernels in all schemes, its limit of the front scheme's
 * time step, its effect on small balls, and its automatic values. kappa is the sum of the principal
 * curvatures.
 */
#ifndef Tension_h
#define Tension_h

#include "Base/FloatLanes.h"

#include <cmath>

namespace activesurface
{

/** Returns the rate of tension [1/time]. An explicit step is stable up to 1 / (sum of the rates of
 * all terms). */
inline double TensionRate(double tension, double voxelSize)
{
  return 4.0 * std::fabs(tension) / (voxelSize * voxelSize);
}

/** Smallest radius R [length] of a ball whose skin survives tension, if the target is the distance
 * to the ball; 0 without tension. The radius r of the steady skin obeys Attraction (R - r) = 2
 * Tension / r, which has no solution for smaller R. */
inline double SmallestBall(double tension, double attraction)
{
  return tension > 0.0 ? std::sqrt(8.0 * tension / attraction) : 0.0;
}

/** Automatic tension for particles: Attraction (spacing / 2)^2 / 2. TensionWeighting reduces this
 * tension to a sixth where the bulk is 1/2 (Nodes/NodeStages.cxx). */
inline double AutomaticTension(double attraction, double spacing)
{
  constexpr double factor = 1.0 / 2.0;
  const double r = 0.5 * spacing;
  return factor * attraction * r * r;
}

/** Automatic tension for labels, whose skin is free within about half a pixel (NodeFreedom).
 * Tension times its duration in a frame (NodeStep.cxx) is 1.2 pixels^2. pixel: shortest side of a
 * pixel. */
inline double AutomaticTensionOfLabels(double attraction, double pixel)
{
  return 0.2 * attraction * pixel * pixel;
}

/** next += tension * kappa * |grad u|. kappa: sum of the principal curvatures [1/voxel]. u, next:
 * a row of eight nodes; X, Y: distances in memory of neighbours along x and y. */
template <int X, int Y>
ACTIVE_ALWAYS_INLINE void AddTension(const float* u, float tension, float* next)
{
  constexpr int Z = 1;
  for (int z = 0; z < 8; ++z)
  {
    const float* c = u + z;
    const float gx = .5f * (c[X] - c[-X]), gy = .5f * (c[Y] - c[-Y]), gz = .5f * (c[Z] - c[-Z]);
    const float hxx = c[X] - 2.f * c[0] + c[-X];
    const float hyy = c[Y] - 2.f * c[0] + c[-Y];
    const float hzz = c[Z] - 2.f * c[0] + c[-Z];
    const float hxy = .25f * ((c[X + Y] - c[X - Y]) - (c[-X + Y] - c[-X - Y]));
    const float hxz = .25f * ((c[X + Z] - c[X - Z]) - (c[-X + Z] - c[-X - Z]));
    const float hyz = .25f * ((c[Y + Z] - c[Y - Z]) - (c[-Y + Z] - c[-Y - Z]));
    const float square = gx * gx + gy * gy + gz * gz;
    const float product = gx * gx * (hyy + hzz) + gy * gy * (hxx + hzz) + gz * gz * (hxx + hyy) -
      2.f * (gx * gy * hxy + gy * gz * hyz + gx * gz * hxz);
    // A vanishing gradient has no normal: use the mean over all normals.
    const float size = std::fabs(hxx) + std::fabs(hyy) + std::fabs(hzz);
    const bool regular = square > 1e-12f * size * size;
    const float rate = regular ? product / square : (2.f / 3.f) * (hxx + hyy + hzz);
    next[z] += tension * rate;
  }
}

/** kappa |grad u| by differences with the neighbours S nodes away, clamped to +-1; 0 where |grad u|
 * <= 0.01. kappa: as in AddTension. c: a row of eight nodes; X1, Y1: distances in memory of
 * neighbours along x and y. */
template <int X1, int Y1, int S>
ACTIVE_ALWAYS_INLINE Lanes Bend(const float* c)
{
  constexpr int X = S * X1, Y = S * Y1, Z = S;
  const auto at = [c](int offset) ACTIVE_INLINED { return LoadLanes(c + offset); };
  const Lanes half = AllLanes(.5f / S), whole = AllLanes(1.f / (S * S));
  const Lanes quarter = AllLanes(.25f / (S * S)), u = at(0);
  const Lanes gx = half * (at(X) - at(-X)), gy = half * (at(Y) - at(-Y)),
              gz = half * (at(Z) - at(-Z));
  const Lanes xx = whole * (at(X) - u - u + at(-X)), yy = whole * (at(Y) - u - u + at(-Y)),
              zz = whole * (at(Z) - u - u + at(-Z));
  const Lanes xy = quarter * ((at(X + Y) - at(X - Y)) - (at(-X + Y) - at(-X - Y)));
  const Lanes xz = quarter * ((at(X + Z) - at(X - Z)) - (at(-X + Z) - at(-X - Z)));
  const Lanes yz = quarter * ((at(Y + Z) - at(Y - Z)) - (at(-Y + Z) - at(-Y - Z)));
  const Lanes square = gx * gx + gy * gy + gz * gz;
  const Lanes product = gx * gx * (yy + zz) + gy * gy * (xx + zz) + gz * gz * (xx + yy) -
    AllLanes(2.f) * (gx * gy * xy + gx * gz * xz + gy * gz * yz);
  constexpr float flat = 1e-4f;
  const LaneMask isRegular = square > AllLanes(flat);
  const Lanes bend = product / Pick(isRegular, square, AllLanes(1.f));
  return Pick(isRegular, Clamp(bend, 1.f), AllLanes(0.f));
}

}

#endif
