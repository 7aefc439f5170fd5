/**
 * Trilinear interpolation within one voxel.
 */
#ifndef Trilinear_h
#define Trilinear_h

namespace activesurface
{

/** Layout of the eight values: corner c = 4 i + 2 j + k of a voxel, i j k in {0,1}. */
constexpr int CornersOfCell = 8;

/** Interpolates from a (t = 0) to b (t = 1): exact at both ends. The result has the sign of a and b
 * if their signs agree. */
inline double Between(double a, double b, double t)
{
  return (1.0 - t) * a + t * b;
}

/**
 * Returns the value at the fractions t in [0,1] of a voxel, and its derivatives by t unless
 * gradient is null. If all corners have one sign, rounding does not change the sign of the value.
 */
inline double Trilinear(const double corner[CornersOfCell], const double t[3], double* gradient)
{
  double edge[4]; // interpolated along k; index 2 i + j
  for (int e = 0; e < 4; ++e)
  {
    edge[e] = Between(corner[2 * e], corner[2 * e + 1], t[2]);
  }
  const double low = Between(edge[0], edge[1], t[1]);
  const double high = Between(edge[2], edge[3], t[1]);
  if (gradient)
  {
    double rise[4];
    for (int e = 0; e < 4; ++e)
    {
      rise[e] = corner[2 * e + 1] - corner[2 * e];
    }
    gradient[0] = high - low;
    gradient[1] = Between(edge[1] - edge[0], edge[3] - edge[2], t[0]);
    gradient[2] = Between(Between(rise[0], rise[1], t[1]), Between(rise[2], rise[3], t[1]), t[0]);
  }
  return Between(low, high, t[0]);
}

}

#endif
