/**
 * The shape of the surface at its start.
 */
#ifndef InitialFunction_h
#define InitialFunction_h

#include <cstddef>
#include <functional>

namespace activesurface
{

/** A function of space, negative inside: values at `count` points (x y z each). */
struct InitialFunction
{
  std::function<void(std::size_t count, const double* points, double* values)> Evaluate;
  bool ThreadSafe = true;
};

}

#endif
