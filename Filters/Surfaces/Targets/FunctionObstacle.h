// A vtkImplicitFunction as an obstacle.

#ifndef FunctionObstacle_h
#define FunctionObstacle_h

#include "Obstacle.h"

#include <array>
#include <memory>

class vtkImplicitFunction;

namespace activesurface
{

// Its distances are F / |grad F|, to first order; where the gradient vanishes or is not finite it
// is far away, on the side of the sign of F. origin: of the obstacle's points. The
// function must not change meanwhile.
std::unique_ptr<Obstacle> MakeObstacle(
  vtkImplicitFunction* function, double voxelSize, const std::array<double, 3>& origin);

}

#endif
