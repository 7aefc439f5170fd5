// All that the motion of a surface depends on: two equal settings move it alike, so that a state is
// kept for as long as the settings are equal to those that it was made with.

#ifndef SurfaceSettings_h
#define SurfaceSettings_h

#include "Motion.h"
#include "SkeletonKernel.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

class vtkBoundingBox;
class vtkImplicitFunction;

namespace activesurface
{

struct ParticleSettings
{
  double Radius = 0.0; // 0: estimated
  double Threshold = 0.5;
  SkeletonKernel Kernel = SkeletonKernel::Wyvill;
};

struct SurfaceSettings
{
  // What attracts: a function, or else the input, which is the same at all steps unless it moves.
  vtkImplicitFunction* TargetFunction = nullptr;
  bool InputMoves = false;
  std::uint64_t TargetStamp = 0;     // of the function, or of all that makes the input
  ParticleSettings Particles;        // and skeletons
  double MeshThickness = 0.0;        // 0: closed meshes
  std::array<std::string, 5> Arrays; // of the inputs, that were chosen

  double IsoValue = 0.0;
  bool Invert = false;
  bool Normalize = true;
  double Reach = 0.0; // 0: an eighth of the diagonal of the bounds

  // Where it starts, unless on the target.
  vtkImplicitFunction* InitialFunction = nullptr;
  bool HasInitialInput = false;
  std::uint64_t InitialStamp = 0; // of the function, or of all that makes the input

  double VoxelSize = 0.0; // 0: a 64th of the longest side of the bounds
  bool BoundsGiven = false;
  std::array<double, 6> Bounds = {};

  bool Bounded = false; // by walls at the bounds

  Motion Strategy;
  bool Settles = false; // goes to rest from the first step, which is the only one
  RestCriterion Rest;
  std::vector<double> Steps;      // pipeline times; the first one is motion time 0
  std::vector<double> InputSteps; // of the input, equal neighbours merged; or empty
  bool OnlyForward = false;       // no step of the input can be had again
  double TimeScale = 1.0;

  bool operator==(const SurfaceSettings& other) const;
  bool operator!=(const SurfaceSettings& other) const { return !(*this == other); }

  // Whether others are these, but that the input has gone on: further steps have been added to its
  // own.
  bool AreContinuedBy(const SurfaceSettings& others) const;

  bool UsesInput() const { return !this->TargetFunction; }

  // Whether Steps are the input's, not the filter's own.
  bool HasStepsOfInput() const;

  double GetMotionTime(double pipelineTime) const;

  // Throws std::invalid_argument, saying which property cannot be as it is.
  void Check() const;
};

// Where a surface starts and at which resolution: known from the bounds.
struct SurfaceDomain
{
  double Bounds[6];
  double VoxelSize;
  double Reach;

  // Lattice nodes within the bounds, first and last of each axis; false if there are too many.
  bool GetExtent(int extent[6]) const;
};

// With the bounds given by the settings.
SurfaceDomain MakeDomain(const SurfaceSettings& settings);

// With the box of the target and the initial shape: shapes enlarged by a quarter of their longest
// side, half of it at each end, and with images by two voxels at each end.
SurfaceDomain MakeDomain(
  const SurfaceSettings& settings, vtkBoundingBox shapes, const vtkBoundingBox& images);

}

#endif
