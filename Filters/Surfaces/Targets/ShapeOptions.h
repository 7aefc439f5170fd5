/**
 * What the kinds of input need of the filter's properties, and of the surface.
 */
#ifndef ShapeOptions_h
#define ShapeOptions_h

#include "SkeletonKernel.h"
#include "Targets/PotentialTarget.h"

namespace activesurface
{

struct ShapeOptions
{
  double ParticleRadius = 0.0; //< of particles and skeletons [length]; 0: estimated
  double Threshold = 0.5;      //< of particles and skeletons
  SkeletonKernel Kernel = SkeletonKernel::Wyvill;
  double MeshThickness = 0.0; //< [length]; 0: closed meshes

  /** Its Reach counts as soon as the bounds are known, and so does VoxelSize [length]. */
  TargetOptions Level;
  double VoxelSize = 0.0;

  /** Spacing of the samples that stand in for gradients that a function does not give [length]. */
  double GetDifferenceStep() const { return 0.125 * this->VoxelSize; }
};

}

#endif
