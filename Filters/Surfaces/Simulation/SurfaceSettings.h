// All that the motion of a surface depends on: two equal settings move it alike, so that a state is
// kept for as long as the settings are equal to those that it was made with.

#ifndef SurfaceSettings_h
#define SurfaceSettings_h

#include "Motion.h"
#include "Simulation/Times.h"
#include "SkeletonKernel.h"

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

class vtkImplicitFunction;

namespace activesurface
{

enum class EvolutionMode
{
  Transient,  // along the time steps
  Equilibrium // to its steady state from the first step, which is the only one
};

struct ParticleSettings
{
  double Radius = 0.0; // 0: estimated
  double Threshold = 0.5;
  SkeletonKernel Kernel = SkeletonKernel::Wyvill;
};

// What comes in through the ports, and the functions in their place.
struct SurfaceInputs
{
  // What attracts: a function, or else the input, which is the same at all steps unless it moves.
  vtkImplicitFunction* TargetFunction = nullptr;
  bool TargetMoves = false;
  std::uint64_t TargetMTime = 0; // of the function, or of all that makes the input

  // Where the surface starts, unless on the target.
  vtkImplicitFunction* InitialFunction = nullptr;
  bool HasInitialInput = false;
  std::uint64_t InitialMTime = 0; // of the function, or of all that makes the input

  std::array<std::string, 5> Arrays; // that were chosen
  std::vector<double> Steps;         // pipeline times; the first one is motion time 0
  std::vector<double> InputSteps;    // of the input; or empty
  bool OnlyForward = false;          // no step of the input can be had again

  bool operator==(const SurfaceInputs& other) const;
};

// Properties come first, each a line of PropertyList.h.
struct SurfaceSettings
{
  Motion Law;
  EvolutionMode Evolution = EvolutionMode::Transient;
  RestCriterion SteadyState;
  double TimeScale = 1.0; // motion time per pipeline time

  double IsoValue = 0.0;
  bool Invert = false;
  bool Normalize = true;
  double Reach = 0.0; // 0: an eighth of the diagonal of the bounds
  ParticleSettings Particles;
  double MeshThickness = 0.0; // 0: closed meshes

  double VoxelSize = 0.0; // 0: a 64th of the longest side of the bounds
  std::array<double, 6> Bounds = { 1.0, -1.0, 1.0, -1.0, 1.0, -1.0 };
  bool Bounded = false; // by walls at the bounds

  SurfaceInputs Inputs;

  bool operator==(const SurfaceSettings& other) const;
  bool operator!=(const SurfaceSettings& other) const { return !(*this == other); }

  // True if `others` differs only by time steps appended to the input's list.
  bool AreContinuedBy(const SurfaceSettings& others) const;

  bool UsesInput() const { return !this->Inputs.TargetFunction; }
  bool IsEquilibrium() const { return this->Evolution == EvolutionMode::Equilibrium; }
  bool HasBounds() const { return this->Bounds != SurfaceSettings().Bounds; }

  int GetNumberOfSteps() const { return static_cast<int>(this->Inputs.Steps.size()); }
  PipelineTime GetStep(int step) const { return { this->Inputs.Steps[step] }; }
  MotionTime ToMotionTime(PipelineTime time) const
  {
    return { this->TimeScale * (time.Value - this->Inputs.Steps.front()) };
  }
  PipelineTime ToPipelineTime(MotionTime time) const
  {
    return { this->Inputs.Steps.front() + time.Value / this->TimeScale };
  }
  MotionTime GetMotionTimeOf(int step) const { return this->ToMotionTime(this->GetStep(step)); }

  // Properties by name and value, for the metadata of files.
  std::vector<std::pair<std::string, double>> ListForFiles() const;

  // Throws std::invalid_argument, saying which property cannot be as it is.
  void Check() const;
};

}

#endif
