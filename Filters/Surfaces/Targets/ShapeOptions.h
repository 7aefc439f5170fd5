/** Values of the filter's properties, and of the surface, that shapes need. */
#ifndef ShapeOptions_h
#define ShapeOptions_h

#include "Frames/PeriodicBox.h"
#include "Index/SkeletonKernel.h"
#include "ParticleModel.h"
#include "Targets/PotentialTarget.h"

namespace activesurface
{

struct ShapeOptions
{
  ParticleModel Model = ParticleModel::Sum; //< of particles; skeletons are always sums
  double ParticleSpacing = 0.0;             //< [length]; 0: estimated
  double SpacingInUse = 0.0;                //< ParticleSpacing or its estimate; 0: unavailable
  double KernelRadius = 0.0; //< support radius of particles, skeletons [length]; 0: by the spacing
  double Anisotropy = 4.0;   //< of particles: largest ratio of axes
  double Threshold = 0.5;    //< of sums of kernels
  SkeletonKernel Kernel = SkeletonKernel::Wyvill;
  PeriodicBox Box;            //< of particles
  double MeshThickness = 0.0; //< [length]; 0: closed meshes

  /** Level.Reach and VoxelSize [length] are valid once the bounds are available. */
  TargetOptions Level;
  double VoxelSize = 0.0;

  bool IsOnNodes = false;    //< particles are a target of the node scheme
  double NoiseAtNodes = 0.0; //< noise at nodes [length], replaces Level.Noise

  /**
   * Carries: the target provides its velocity. WeighsTension: the target determines where tension
   * acts. OpensHollows: hollows can open.
   */
  bool Carries = false;
  bool WeighsTension = false;
  bool OpensHollows = false;

  /** Returns true if the distinction between bodies and isolated particles matters. */
  bool WantsBulks() const { return this->WeighsTension || this->NoiseAtNodes > 0.0; }

  /** Step of central differences, for functions without a gradient [length]. */
  double GetDifferenceStep() const { return 0.125 * this->VoxelSize; }
};

}

#endif
