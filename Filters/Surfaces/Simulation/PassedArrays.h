// What the skin takes of the particles under it.

#ifndef PassedArrays_h
#define PassedArrays_h

#include "Simulation/ParticleMoment.h"
#include "SkeletonKernel.h"

#include <vector>

class vtkFloatArray;
class vtkPolyData;

namespace activesurface
{

struct PassedArrays
{
  ParticleMoment Moment; // without particles: nothing is passed
  SkeletonKernel Kernel = SkeletonKernel::Wyvill;
  bool Arrays = false;            // all point arrays of the particles
  std::vector<double> Velocities; // of the particles, x y z each, NaN for unknown; or empty
};

// Gives the skin the particles' arrays: floating-point ones and colours (unsigned char, of 3 or 4
// components; rounded to the nearest whole number, halves upwards) as averages with the kernels'
// weights, others from the particle of the largest weight. A name that the skin has already, or
// that is not alike at both steps around the moment, is left out, and so are ghost levels. To the
// skin's "Velocity", which is along the directions, adds the average velocity of the particles, but
// for what is along the directions. Does nothing without particles.
void PassArrays(const PassedArrays& passed, const vtkFloatArray* directions, vtkPolyData* skin);

}

#endif
