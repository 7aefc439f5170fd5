// What the skin takes of the particles under it.

#ifndef CarriedArrays_h
#define CarriedArrays_h

#include "ParticleMoment.h"
#include "SkeletonKernel.h"

#include <vector>

class vtkFloatArray;
class vtkPolyData;

namespace activesurface
{

struct CarriedArrays
{
  ParticleMoment Moment; // without particles: nothing is carried
  SkeletonKernel Kernel = SkeletonKernel::Wyvill;
  bool Arrays = false;            // all point arrays of the particles
  std::vector<double> Velocities; // of the particles, x y z each, NaN for unknown; or empty
};

// Gives the skin the particles' arrays: floating-point ones as averages with the kernels' weights,
// others from the particle of the largest weight. A name that the skin has already, or that is not
// alike at both steps around the moment, is left out, and so are ghost levels. To the skin's
// "Velocity", which is along the directions, adds the average velocity of the particles, but for
// what is along the directions. Does nothing without particles.
void Carry(const CarriedArrays& carried, const vtkFloatArray* directions, vtkPolyData* skin);

}

#endif
