// All settings that determine the motion of a surface. Equal settings yield equal motion, so a
// state stays valid until a setting changes.

#ifndef SurfaceSettings_h
#define SurfaceSettings_h

#include "Base/Automatic.h"
#include "Base/Motion.h"
#include "Base/TimeSteps.h"
#include "Index/SkeletonKernel.h"
#include "ParticleModel.h"
#include "Simulation/Times.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

class vtkImplicitFunction;

namespace activesurface
{

enum class EvolutionMode
{
  Transient,  // moves along the time steps
  Equilibrium // moves to a steady state on the first step's target
};

// NodesIfPossible: the node scheme over particles and labels, unless a setting needs substeps.
enum class IntegrationChoice
{
  Explicit,
  NodesIfPossible
};

struct ParticleSettings
{
  ParticleModel Model = ParticleModel::Anisotropic;
  double Spacing = Automatic; // estimated
  double Radius = Automatic;  // from the spacing
  double Anisotropy = 4.0;
  double Threshold = 0.5;
  SkeletonKernel Kernel = SkeletonKernel::Wyvill;
  std::array<double, 6> Periodic = { 1.0, -1.0, 1.0, -1.0, 1.0, -1.0 }; // on axes with min < max

  bool IsPeriodic(std::size_t axis) const
  {
    return this->Periodic[2 * axis] < this->Periodic[2 * axis + 1];
  }
  bool ArePeriodic() const
  {
    return this->IsPeriodic(0) || this->IsPeriodic(1) || this->IsPeriodic(2);
  }
};

// Inputs of the ports and the functions that replace them.
struct SurfaceInputs
{
  // Target: a function, or the input if null. The input is static unless TargetMoves.
  vtkImplicitFunction* TargetFunction = nullptr;
  bool TargetMoves = false;
  std::uint64_t TargetMTime = 0; // of the function, or of the whole upstream pipeline

  // Initial shape: a function; if null, the input of port 1; without this input, the target.
  vtkImplicitFunction* InitialFunction = nullptr;
  bool HasInitialInput = false;
  std::uint64_t InitialMTime = 0; // of the function, or of the whole upstream pipeline

  // Obstacle that the surface may not enter; null: none.
  vtkImplicitFunction* ObstacleFunction = nullptr;
  std::uint64_t ObstacleMTime = 0;

  std::array<std::string, 5> Arrays; // descriptions of the selected arrays
  std::vector<double> Steps;         // pipeline times; the first one is motion time 0
  // Of the input, without repeated times; if OnlyForward, the requested or pushed times. May be
  // empty.
  std::vector<double> InputSteps;
  bool OnlyForward = false; // the input cannot repeat a step

  // Returns true if Steps are times of the input, of requests or of pushed frames, not of the
  // filter's own clock.
  bool HaveOwnSteps() const { return this->OnlyForward || this->InputSteps.size() > 1; }

  bool WithdrawStep() // removes the last step of a forward-only input
  {
    this->Steps.pop_back();
    this->InputSteps.pop_back();
    return true;
  }

  bool operator==(const SurfaceInputs& other) const;
};

// Each property is a field of this struct or of a member, and a line of ForEachProperty below.
struct SurfaceSettings
{
  Motion Parameters;             // without Attraction and Tension
  double Attraction = Automatic; // see GetLaw
  double Tension = Automatic;    // see GetLaw
  EvolutionMode Evolution = EvolutionMode::Transient;
  SteadyStateCriterion SteadyState;
  double TimeScale = 1.0;   // motion time per pipeline time
  double Noise = Automatic; // of the target [length]
  IntegrationChoice Integration = IntegrationChoice::NodesIfPossible;
  double ArrivalTime = 0.0; // pipeline time after the first step; 0: no arrival

  double IsoValue = 0.0;
  bool Invert = false;
  bool Normalize = true;
  double Reach = Automatic; // see SurfaceDomain
  ParticleSettings Particles;
  double MeshThickness = 0.0; // 0: no shell

  double VoxelSize = Automatic; // see SurfaceDomain
  std::array<double, 6> Bounds = { 1.0, -1.0, 1.0, -1.0, 1.0, -1.0 };
  bool Bounded = false; // walls at the bounds

  SurfaceInputs Inputs;

  bool operator==(const SurfaceSettings& other) const;
  bool operator!=(const SurfaceSettings& other) const { return !(*this == other); }

  // Returns true if `others` append time steps to the input's list, and otherwise differ at most by
  // TargetMTime and TargetMoves. Returns false with EQUILIBRIUM or a TargetFunction, and if the
  // list is empty here.
  bool AreContinuedBy(const SurfaceSettings& others) const;

  bool UsesInput() const { return !this->Inputs.TargetFunction; }
  bool StartsElsewhere() const // on an initial shape instead of the target
  {
    return this->Inputs.InitialFunction || this->Inputs.HasInitialInput;
  }
  bool IsEquilibrium() const { return this->Evolution == EvolutionMode::Equilibrium; }
  bool HasAutomaticAttraction() const
  {
    return this->Attraction == Automatic && !this->Parameters.Paper && !this->IsEquilibrium();
  }
  // Returns Parameters with the set Attraction and Tension; an automatic Attraction is 1 here, an
  // automatic Tension 0.
  Motion GetLaw() const;
  // Returns the first property whose value the node scheme does not support; null: all are
  // supported.
  const char* FindWhatNeedsSubsteps() const;
  bool UsesNodes() const { return !this->FindWhatNeedsSubsteps(); }
  // Least Attraction * duration of a time step for the node scheme; below this value substeps
  // replace the node scheme. The node scheme evaluates the target only near the target's surface.
  // If the skin's distance to the target falls by less than a factor e^2, the skin may be outside
  // this region.
  static constexpr double FewestFactorsOfNodes = 2.0;
  // Returns true if ranks may partition space over particles: the input moves, the node scheme
  // makes all time steps, and particles are anisotropic, without an array of radii; VolumeControl,
  // AreaControl, a periodic box and an initial shape are absent.
  bool CanShareSpace() const;
  // Returns true if the automatic noise is not 0 over particles. The automatic tension also needs
  // WeightedTension.
  bool SmoothsParticles() const
  {
    return this->Particles.Model != ParticleModel::Sum && this->UsesNodes();
  }
  bool HasAutomaticTension() const
  {
    return this->SmoothsParticles() && this->Parameters.WeightedTension &&
      this->Tension == Automatic;
  }
  // Time at which the surface reaches the target; 0: no arrival.
  MotionTime GetArrival() const { return { this->TimeScale * this->ArrivalTime }; }
  bool ArrivesAfter(MotionTime time) const
  {
    return !this->IsEquilibrium() && time.Value < this->GetArrival().Value;
  }
  // Returns true if voxel size and target reach follow from the settings only.
  bool HasOwnSizes() const
  {
    return this->Particles.Spacing > 0.0 || (this->VoxelSize > 0.0 && this->Reach > 0.0);
  }
  bool HasBounds() const { return this->Bounds != SurfaceSettings().Bounds; }

  int GetNumberOfSteps() const { return static_cast<int>(this->Inputs.Steps.size()); }
  RequestedTime FindRequested(PipelineTime time) const
  {
    const StepOfTime found = FindStep(this->Inputs.Steps, time.Value);
    return { found.Step, { found.Time }, found.Between };
  }
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

  // Properties by name and value, for the metadata of files; without boxes and the voxel size.
  std::vector<std::pair<std::string, double>> ListForFiles() const;

  // Throws std::invalid_argument, with a message for the user, if a property is invalid.
  void Check() const;
};

// Valid numbers of a property. Words: for the message "<Name> has to be <Words>, but is ...".
struct PropertyRange
{
  double Low;
  double High;
  bool ZeroToo;
  const char* Words;
  bool AutomaticToo = false;

  bool Includes(double value) const
  {
    return std::isfinite(value) &&
      ((value >= this->Low && value <= this->High) || (this->ZeroToo && value == 0.0) ||
        (this->AutomaticToo && value == Automatic));
  }
};

struct Property
{
  const char* Name;
  PropertyRange Range;
};

// Throws std::invalid_argument for a value out of range.
void CheckProperty(const Property& property, double value);

namespace ranges
{

constexpr double Largest = std::numeric_limits<double>::max();
constexpr double Smallest = std::numeric_limits<double>::denorm_min();
// Shorter lengths are errors, because speeds are stored in single precision.
constexpr double ShortestLength = 1e-30;
constexpr double LongestLength = 1e30;

constexpr PropertyRange Any{ -Largest, Largest, true, "a finite number" };
constexpr PropertyRange AtLeastZero{ 0.0, Largest, true, "a finite number >= 0" };
constexpr PropertyRange Positive{ Smallest, Largest, false, "a finite number > 0" };

constexpr PropertyRange OrZero(const char* words)
{
  return { Smallest, Largest, true, words };
}

constexpr PropertyRange Length(const char* words, bool zeroToo = false)
{
  return { ShortestLength, LongestLength, zeroToo, words, true };
}

constexpr PropertyRange OrAutomatic(double low, bool zeroToo, const char* words)
{
  return { low, Largest, zeroToo, words, true };
}

constexpr PropertyRange Between(double low, double high, const char* words)
{
  return { low, high, false, words };
}

}

// A line of ForEachProperty: name of the property, its field, its range.
#define ACTIVE_PROPERTY(name, field, range)                                                        \
  visit(Property{ #name, range }, field, [](auto& filter) { return filter.Get##name(); })

// Calls visit(property, field, getter) for each property that determines the motion, except
// functions and the clock; the getter returns the property's value from the filter. The filter's
// header declares the properties by VTK's macros.
template <class Settings, class Visitor>
void ForEachProperty(Settings& settings, Visitor&& visit)
{
  using namespace ranges;
  auto& motion = settings.Parameters;
  auto& particles = settings.Particles;
  ACTIVE_PROPERTY(TargetIsoValue, settings.IsoValue, Any);
  ACTIVE_PROPERTY(InvertTarget, settings.Invert, Any);
  ACTIVE_PROPERTY(NormalizeTarget, settings.Normalize, Any);
  ACTIVE_PROPERTY(TargetReach, settings.Reach,
    OrAutomatic(Smallest, false, "a finite number > 0, or -1, automatic"));
  ACTIVE_PROPERTY(
    MeshThickness, settings.MeshThickness, Between(0.0, LongestLength, "between 0 and 1e30"));

  ACTIVE_PROPERTY(ParticleModel, particles.Model, Any);
  ACTIVE_PROPERTY(
    ParticleSpacing, particles.Spacing, Length("between 1e-30 and 1e30, or -1, automatic"));
  ACTIVE_PROPERTY(
    KernelRadius, particles.Radius, Length("between 1e-30 and 1e30, or -1, automatic"));
  ACTIVE_PROPERTY(Anisotropy, particles.Anisotropy, Between(1.0, 100.0, "between 1 and 100"));
  ACTIVE_PROPERTY(ParticleKernel, particles.Kernel, Any);
  ACTIVE_PROPERTY(ParticleThreshold, particles.Threshold,
    Between(Smallest, Largest, "a finite number > 0 (below 0 all space would be inside)"));
  ACTIVE_PROPERTY(PeriodicBounds, particles.Periodic, Any);

  ACTIVE_PROPERTY(
    VoxelSize, settings.VoxelSize, Length("between 1e-30 and 1e30, or -1, automatic"));
  ACTIVE_PROPERTY(ModelBounds, settings.Bounds, Any);
  ACTIVE_PROPERTY(BoundedDomain, settings.Bounded, Any);

  ACTIVE_PROPERTY(Attraction, settings.Attraction,
    OrAutomatic(0.0, true, "a finite number >= 0, or -1, automatic"));
  ACTIVE_PROPERTY(Tension, settings.Tension,
    OrAutomatic(
      0.0, true, "a finite number >= 0 (below 0 the motion is unstable), or -1, automatic"));
  ACTIVE_PROPERTY(TensionWeighting, motion.WeightedTension, Any);
  ACTIVE_PROPERTY(
    TargetNoise, settings.Noise, Length("0, between 1e-30 and 1e30, or -1, automatic", true));
  ACTIVE_PROPERTY(Transport, motion.Transport, Between(0.0, 1.0, "between 0 and 1"));
  ACTIVE_PROPERTY(CreateParts, motion.CreateParts, Any);
  ACTIVE_PROPERTY(EvolutionMode, settings.Evolution, Any);
  ACTIVE_PROPERTY(RestTolerance, settings.SteadyState.Tolerance, AtLeastZero);
  ACTIVE_PROPERTY(MaximumNumberOfSubsteps, settings.SteadyState.MaximumSubsteps, Any);
  ACTIVE_PROPERTY(TimeIntegration, settings.Integration, Any);
  // Below 1e-6 a substep's displacement is lost in rounding.
  ACTIVE_PROPERTY(CFL, motion.CFL, Between(1e-6, 1.0, "between 1e-6 and 1"));
  ACTIVE_PROPERTY(TargetEvaluation, motion.Evaluation, Any);
  ACTIVE_PROPERTY(GradientScheme, motion.Gradient, Any);
  ACTIVE_PROPERTY(PaperScheme, motion.Paper, Any);

  ACTIVE_PROPERTY(VolumeControl, motion.VolumeControl, Any);
  ACTIVE_PROPERTY(VolumeStiffness, motion.VolumeStiffness, AtLeastZero);
  ACTIVE_PROPERTY(TargetVolume, motion.TargetVolume,
    OrZero("a finite number > 0, or 0 for the volume of the initial skin"));
  ACTIVE_PROPERTY(AreaControl, motion.AreaControl, Any);
  ACTIVE_PROPERTY(AreaStiffness, motion.AreaStiffness, AtLeastZero);
  ACTIVE_PROPERTY(TargetArea, motion.TargetArea,
    OrZero("a finite number > 0, or 0 for the area of the initial skin"));

  ACTIVE_PROPERTY(TimeScale, settings.TimeScale, Positive);
  ACTIVE_PROPERTY(
    ArrivalTime, settings.ArrivalTime, OrZero("a finite number > 0, or 0 for no arrival time"));
}

}

#endif
