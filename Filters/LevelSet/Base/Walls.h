/**
 * A box that confines the surface.
 */
#ifndef Walls_h
#define Walls_h

#include <algorithm>
#include <cmath>

namespace activesurface
{

struct Walls
{
  bool Present = false;
  double Bounds[6] = {}; //< xmin xmax ymin ymax zmin zmax, world units
};

/** A periodic box [world units]: a surface that leaves through one side enters through the opposite
 * side. */
struct Periods
{
  double Low[3] = {};
  double Length[3] = {}; //< 0: not periodic along the axis

  bool Any() const { return this->Length[0] > 0. || this->Length[1] > 0. || this->Length[2] > 0.; }
};

/** Returns the distance to the box, negative inside. */
inline double DistanceToWalls(const Walls& walls, const double x[3])
{
  double inside = -HUGE_VAL, square = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double beyond =
      std::max(walls.Bounds[2 * axis] - x[axis], x[axis] - walls.Bounds[2 * axis + 1]);
    inside = std::max(inside, beyond);
    square += beyond > 0.0 ? beyond * beyond : 0.0;
  }
  return square > 0.0 ? std::sqrt(square) : inside;
}

}

#endif
