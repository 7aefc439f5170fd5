// The state of a surface and its way through time, whatever the order in which times are asked for.
//
// The surface goes from one step to the next, so that the states at the steps, the trajectory, do
// not depend on which times between the steps were asked for. A time between two steps is reached
// by a branch, a copy of the earlier step's state, which leaves the trajectory as it is.
//
// Moving particles come in from outside, one step after the other:
//
//   simulation.Configure(settings);
//   simulation.SetGoal(time);
//   while (simulation.Advance(progress) == SurfaceSimulation::Outcome::NeedsParticles)
//     simulation.AddParticles(step = simulation.GetStepWanted(), the particles of that step);
//   simulation.GetBand() is the surface at that time

#ifndef SurfaceSimulation_h
#define SurfaceSimulation_h

#include "ImplicitTarget.h"
#include "NarrowBand.h"
#include "ParticleFrames.h"
#include "ParticleTarget.h"
#include "SurfaceSettings.h"

#include <cstddef>
#include <functional>
#include <memory>
#include <set>
#include <string>

namespace activesurface
{

class SurfaceSimulation
{
public:
  enum class Outcome
  {
    AtGoal,
    NeedsParticles, // of the step GetStepWanted
    Aborted         // by the progress function; the state is lost
  };

  // Told, once for each reason and as long as the settings stay the same, what a user should know.
  using Warning = std::function<void(const std::string& sentence)>;
  void SetWarning(const Warning& warning) { this->Tell = warning; }

  // Neither of them changes the motion.
  void SetNumberOfThreads(int threads) { this->Threads = threads; }
  void SetMaximumNumberOfActiveVoxels(std::size_t maximum) { this->MaximumVoxels = maximum; }

  // Drops everything if these are other settings.
  void Configure(const SurfaceSettings& settings);
  const SurfaceSettings& GetSettings() const { return this->Settings; }

  // What makes the particles has changed its stamp, but not them.
  void SetTargetStamp(std::uint64_t stamp) { this->Settings.TargetStamp = stamp; }

  // The pipeline time to go to; before the first step is the first, after the last the last one,
  // and a millionth of their distance from a step is that step. A time before the step that the
  // surface is at takes it back to the start.
  void SetGoal(double pipelineTime);
  double GetGoalTime() const { return this->Goal.Time; }

  // The step whose particles have to come next, or -1 if none are needed to reach the goal; and the
  // step that came last, or 0.
  int GetStepWanted() const;
  int GetLastStepAdded() const { return this->LastStepAdded; }
  void AddParticles(int step, ParticleFrame frame);

  // Goes as far as the particles allow. Throws std::invalid_argument for settings that cannot be,
  // and what NarrowBand throws; the state then is to be dropped.
  Outcome Advance(const ProgressFunction& progress);

  // Forget the state, and the particles.
  void Drop();

  // At the goal, when Advance has reached it.
  const NarrowBand& GetBand() const;

  // Null as long as the bounds are not known: before particles were added, or for functions that
  // have none. Throws for settings that cannot be.
  const SurfaceDomain* FindDomain();

  std::size_t GetSubsteps() const { return this->Substeps; }
  std::size_t GetTargetEvaluations() const { return this->TargetEvaluations; }
  void ResetCounters() { this->Substeps = this->TargetEvaluations = 0; }

private:
  struct GoalTime
  {
    int Step = 0;         // the last one that is not after the goal
    double Time = 0.0;    // pipeline time
    bool Between = false; // after that step
  };

  GoalTime FindGoal(double pipelineTime) const;
  bool UsesParticles() const { return !this->Settings.TargetFunction; }
  bool HasParticlesFrom(int step) const;
  bool BranchIsAtGoal() const;
  bool FindShapeBounds(double bounds[6]) const;
  ProgressFunction GetPartOf(const ProgressFunction& progress) const;

  bool Start(const ProgressFunction& progress);
  bool AdvanceStep(const ProgressFunction& progress);
  bool AdvanceBranch(const ProgressFunction& progress);
  bool AdvanceBand(NarrowBand& band, double time, const ProgressFunction& progress);
  void MakeTarget(const SurfaceDomain& domain);
  bool StartBand(const SurfaceDomain& domain, const ProgressFunction& progress);
  void GiveRadii(ParticleFrame& frame);
  void Warn(const std::string& reason, const std::string& sentence);
  void WarnOf(const AdvanceReport& report, double time);

  SurfaceSettings Settings;
  int Threads = 0;
  std::size_t MaximumVoxels = 0;
  Warning Tell;
  std::set<std::string> Told;

  ParticleFrames Frames;
  int LastStepAdded = 0;
  double EstimatedRadius = 0.0;
  bool DomainKnown = false;
  SurfaceDomain Domain;

  GoalTime Goal;
  int FirstStep = -1; // where the way to the goal began, for the progress
  std::unique_ptr<PotentialTarget> Attractor;
  ParticleTarget* MovingAttractor = nullptr; // the same, if particles
  std::unique_ptr<NarrowBand> Band;          // at the step
  int Step = -1;                             // -1: not started
  std::unique_ptr<NarrowBand> Branch;
  double BranchTime = 0.0; // pipeline time

  std::size_t Substeps = 0;
  std::size_t TargetEvaluations = 0;
};

}

#endif
