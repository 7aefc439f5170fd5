/** Values of the filter's properties, and of the surface, that shapes and targets need. */

#ifndef TargetOptions_h
#define TargetOptions_h

#include "Frames/PeriodicBox.h"
#include "Index/SkeletonKernel.h"
#include "ParticleModel.h"

#include <limits>
#include <string>

namespace activesurface
{

struct ParticleFrame;

struct TargetOptions
{
  double IsoValue = 0.0;
  bool Invert = false;
  /**
   * Use the first-order distance (F - iso) / |grad F|, clamped to +-Reach, instead of F - iso.
   * Where the gradient vanishes or is not finite, the value is +-Reach with the sign of F - iso, or
   * 0 if F = iso.
   */
  bool Normalize = true;
  double Reach = std::numeric_limits<double>::infinity();
  /**
   * Distance below which a deviation of the surface may be noise [length]. Within this distance the
   * attraction is reduced, down to 3 %. 0: no reduction. Used with Normalize only.
   */
  double Noise = 0.0;
  double NoiseAtNodes = 0.0;  //< replaces Noise in the node scheme [length]
  bool IsDomainKnown = false; //< otherwise VoxelSize is 0, Reach infinite
  double VoxelSize = 0.0;     //< [length]
  bool SmoothsLabels = false; //< images of labels are a target of the node scheme
  double LabelNoise = -1.0;   //< freedom of the skin around a label [length]; < 0: automatic

  ParticleModel Model = ParticleModel::Sum; //< of particles; skeletons are always sums
  double Spacing = 0.0; //< of the particles, given or estimated [length]; 0: unknown
  /** Support radius of particles and skeletons [length]; 0: from the spacing. */
  double KernelRadius = 0.0;
  double Anisotropy = 4.0; //< of particles: largest ratio of axes
  double Threshold = 0.5;  //< of sums of kernels
  SkeletonKernel Kernel = SkeletonKernel::Wyvill;
  PeriodicBox Box;            //< of particles
  double MeshThickness = 0.0; //< of the shell around an open mesh [length]; 0: no shell
  double MeshReach = 0.0;     //< width around a mesh in which distances are needed [length]
  double MeshVoxels = 0.0;    //< limit for the distances to a mesh [voxels]

  bool IsOnNodes = false;     //< particles are a target of the node scheme
  bool Carries = false;       //< the target provides its velocity
  bool WeighsTension = false; //< the target determines where tension acts
  bool OpensHollows = false;

  std::string When;     //< "at the time step 2", for messages
  std::string MeshHint; //< appended to errors of size; explains MeshReach, MeshVoxels

  /** Returns true if the distinction between bodies and isolated particles matters. */
  bool WantsBulks() const { return this->WeighsTension || this->NoiseAtNodes > 0.0; }
  /** Step of central differences, for functions without a gradient [length]. */
  double GetDifferenceStep() const { return 0.125 * this->VoxelSize; }

  /** Support radius of points without a radius of their own [length]. */
  double GetRadius(ParticleModel model) const;
  /**
   * Support radius of an isolated particle's kernel, divided by the radius of the particle's ball.
   */
  double GetReachPerRadius(ParticleModel model) const;
  /** Sets the support radii of a frame's particles, from their radii if there are any. */
  void GiveRadii(ParticleModel model, ParticleFrame& frame) const;
};

}

#endif
