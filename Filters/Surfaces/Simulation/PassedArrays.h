// Transfers point arrays and velocities of the particles to the skin.

#ifndef PassedArrays_h
#define PassedArrays_h

#include "Index/SkeletonKernel.h"
#include "ParticleTrack.h"

#include <optional>
#include <vector>

class vtkFloatArray;
class vtkPolyData;

namespace activesurface
{

struct PassedArrays
{
  std::optional<ParticleTrack> Particles; // at the requested time; if none, nothing is passed
  SkeletonKernel Kernel = SkeletonKernel::Wyvill;
  bool Arrays = false;            // all point arrays of the particles
  std::vector<double> Velocities; // x y z of each particle [length/time], NaN: unknown; or empty
};

// Adds the particles' arrays to the skin. Floating-point arrays and colours (unsigned char, 3 or 4
// components; rounded to the nearest integer, halves upwards) are averages with the weights of the
// kernels (ParticleWeights, PassedArrays.cxx); other arrays have the value of the particle of the
// largest weight. Omits ghost levels, arrays without a name, and arrays whose name an array of the
// skin has already. Between two steps, omits arrays that one of the steps lacks, or that differ
// between the steps in type or number of components.
//
// The skin's array "Velocity" is along `directions` (unit vectors). If the particles have
// velocities, adds to this array the average velocity without its component along `directions`.
// Does nothing without particles.
void PassArrays(const PassedArrays& passed, const vtkFloatArray* directions, vtkPolyData* skin);

}

#endif
