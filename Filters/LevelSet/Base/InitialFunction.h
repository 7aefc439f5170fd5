/**
 * The initial shape of the surface.
 */
#ifndef InitialFunction_h
#define InitialFunction_h

#include "Base/TargetRegion.h"

#include <cstddef>
#include <functional>
#include <memory>

namespace activesurface
{

/** Points near the zero set of a function. */
struct SurfacePoints
{
  /** Visits the points (x y z). Empty: the points are unknown. */
  std::function<void(const std::function<void(const double x[3])>& visit)> ForEach;

  /** Half the side of a cube centred at each point [length]. Every zero of the function, except at
   * walls, lies in one of these cubes. */
  double Reach = 0.0;

  /** Box outside which the function is not negative. */
  double Bounds[6] = {};

  /** Largest distance from a face of NarrowBand::Start's bounds to a wall that cuts the shape
   * [length].
   */
  double DepthOfWalls = 0.0;
};

/** A function of space, negative inside: values at `count` points (x y z each). */
struct InitialFunction
{
  std::function<void(std::size_t count, const double* points, double* values)> Evaluate;
  bool ThreadSafe = true;

  /**
   * Visits boxes that together contain the zero set. With boxes, NarrowBand::Start evaluates the
   * function only at nodes near the boxes, and where the bounds cut the shape. Empty: the boxes are
   * unknown. If Surface is unknown too, the function is sampled everywhere within the bounds.
   */
  std::function<void(const RegionVisitor& visit)> ForEachRegion;

  /**
   * Points near the zero set. If the points are known, NarrowBand::Start uses the points instead of
   * the boxes, and evaluates the function only near the points and near the faces of the bounds.
   * The potential is bitwise identical to a potential from samples everywhere within the bounds.
   */
  SurfacePoints Surface;
};

}

#endif
