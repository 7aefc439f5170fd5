// Returns 0 up to `from`, 1 beyond `to`, and 3 t^2 - 2 t^3 between; `from` may exceed `to`.

#ifndef SmoothStep_h
#define SmoothStep_h

#include <algorithm>

namespace activesurface
{

inline double SmoothStep(double from, double to, double x)
{
  const double t = std::min(std::max((x - from) / (to - from), 0.0), 1.0);
  return t * t * (3.0 - 2.0 * t);
}

}

#endif
