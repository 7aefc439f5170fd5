/**
 * What the kinds of input need of the filter's properties, and of the surface.
 */
#ifndef ShapeOptions_h
#define ShapeOptions_h

#include "ParticleModel.h"
#include "SkeletonKernel.h"
#include "Targets/PeriodicBox.h"
#include "Targets/PotentialTarget.h"

namespace activesurface
{

struct ShapeOptions
{
  ParticleModel Model = ParticleModel::Sum; //< of particles; skeletons are sums
  double ParticleSpacing = 0.0;             //< [length]; 0: estimated
  double SpacingInUse = 0.0;                //< the same, or the estimate; 0: not known
  double KernelRadius = 0.0; //< reach of particles and skeletons [length]; 0: by the spacing
  double Anisotropy = 4.0;   //< of particles, largest ratio of axes
  double Threshold = 0.5;    //< of sums
  SkeletonKernel Kernel = SkeletonKernel::Wyvill;
  PeriodicBox Box;            //< of particles
  double MeshThickness = 0.0; //< [length]; 0: closed meshes

  /** Its Reach counts as soon as the bounds are known, and so does VoxelSize [length]. */
  TargetOptions Level;
  double VoxelSize = 0.0;

  bool IsOnNodes = false;    //< whether particles are a target of the node scheme
  double NoiseAtNodes = 0.0; //< and their noise there [length], in place of the level's

  /** Whether the target tells its velocity, where tension is to act, and where hollows can be. */
  bool Carries = false;
  bool WeighsTension = false;
  bool OpensHollows = false;

  /** Returns true if a target at points looks at the particles' neighbours; and if it needs to. */
  bool WantsFits() const { return this->NeedsFits() || this->OpensHollows; }
  bool NeedsFits() const { return this->Model != ParticleModel::Sum; }
  /** Returns true for the model whose fits nodes do not find themselves. */
  bool NodesNeedFits() const { return this->Model == ParticleModel::AveragedCentre; }

  /** Whether what is a body of particles matters. */
  bool WantsBulks() const { return this->WeighsTension || this->NoiseAtNodes > 0.0; }

  /** Spacing of the samples that stand in for gradients that a function does not give [length]. */
  double GetDifferenceStep() const { return 0.125 * this->VoxelSize; }
};

}

#endif
