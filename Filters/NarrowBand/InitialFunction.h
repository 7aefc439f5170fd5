/**
 * The shape of the surface at its start.
 */
#ifndef InitialFunction_h
#define InitialFunction_h

#include "TargetRegion.h"

#include <cstddef>
#include <functional>
#include <memory>

namespace activesurface
{

/** Places near the zero set of a function. */
struct SurfacePoints
{
  /** Visits them (x y z). Empty: not known. */
  std::function<void(const std::function<void(const double x[3])>& visit)> ForEach;

  /** Wherever the function changes sign, but at walls, one of them is so near along each axis
   * [length]. */
  double Reach = 0.0;

  /** Box outside which the function is not negative. */
  double Bounds[6] = {};

  /** Walls so deep within the bounds of the start may cut the shape off [length]. */
  double DepthOfWalls = 0.0;
};

/** A function of space, negative inside: values at `count` points (x y z each). */
struct InitialFunction
{
  std::function<void(std::size_t count, const double* points, double* values)> Evaluate;
  bool ThreadSafe = true;

  /**
   * Visits boxes that together hold the zero set: the start then costs what they hold, whatever the
   * bounds. Elsewhere the function keeps its sign, and is not evaluated. Empty: not known; the
   * function is sampled everywhere within the bounds.
   */
  std::function<void(const RegionVisitor& visit)> ForEachRegion;

  /**
   * Points near the zero set, if there are any, in place of regions: the start then costs what is
   * near the points, and is bitwise the one without them.
   */
  SurfacePoints Surface;
};

}

#endif
