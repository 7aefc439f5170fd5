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
// is far away, on the side that F tells. origin: what the obstacle's points are relative to. The
// function must not change meanwhile.
std::unique_ptr<Obstacle> MakeObstacle(
  vtkImplicitFunction* function, double voxelSize, const std::array<double, 3>& origin);

}

#endif
