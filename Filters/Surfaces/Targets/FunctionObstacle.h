// A vtkImplicitFunction as an obstacle.

#ifndef FunctionObstacle_h
#define FunctionObstacle_h

#include "Base/Obstacle.h"

#include <array>
#include <memory>

class vtkImplicitFunction;

namespace activesurface
{

// The distances are F / |grad F|, exact to first order. Where the gradient vanishes or is not
// finite, the distance is infinite with the sign of F, or 0 if F is 0. origin: origin of the
// obstacle's points. The function must not change during the obstacle's lifetime.
std::unique_ptr<Obstacle> MakeObstacle(
  vtkImplicitFunction* function, double voxelSize, const std::array<double, 3>& origin);

}

#endif
