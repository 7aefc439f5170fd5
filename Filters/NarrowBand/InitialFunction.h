/**
 * The shape of the surface at its start.
 */
#ifndef InitialFunction_h
#define InitialFunction_h

#include "TargetRegion.h"

#include <cstddef>
#include <functional>

namespace activesurface
{

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
};

}

#endif
