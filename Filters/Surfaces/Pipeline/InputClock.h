// Time steps of a filter: the target's steps, or the filter's own.
//
// In situ, future steps of the target are unavailable. There are three cases:
// - The target's list of time steps grows.
// - The target offers each time only once (NO_PRIOR_TEMPORAL_ACCESS, VTK 9.4 and later). The steps
//   are then the requested times.
// - Frames are pushed (PushedFrames.h). The steps are then the times of the frames.

#ifndef InputClock_h
#define InputClock_h

#include "Simulation/SurfaceSettings.h"

#include <vector>

class vtkInformation;

namespace activesurface
{

// The filter's own clock, for a target with fewer than two time steps.
struct ClockProperties
{
  double StartTime = 0.0; // in pipeline time, like TimeStepSize
  double TimeStepSize = 0.1;
  int NumberOfTimeSteps = 11;
};

class InputClock
{
public:
  // Uses the filter's properties and the target's information, which is null without an input
  // target.
  void Read(const ClockProperties& properties, bool isEquilibrium, vtkInformation* target);
  // Uses the times of pushed frames as the steps.
  void Read(const std::vector<double>& pushed);

  // Continues a sequence of times from a target that offers each time only once: `times` were
  // requested before.
  void Resume(const std::vector<double>& times) { this->Requested = times; }
  // Call this before requesting data for a time. Returns true if the target starts a new sequence
  // of times, so that earlier data have to be discarded.
  bool Request(vtkInformation* target, double time);

  // Returns true if the steps are the times of pushed frames. GetNewest returns the last time.
  bool ArePushed() const { return this->IsPushed; }
  PipelineTime GetNewest() const { return { this->Steps.back() }; }

  // Writes TargetMoves, OnlyForward, Steps and InputSteps.
  void WriteTo(SurfaceInputs& inputs) const;

  // TIME_STEPS to publish; with EQUILIBRIUM the first step, which is not published. For a target
  // that offers each time only once, these are the target's own steps, if any. For pushed frames
  // there are no steps, because only the newest frame is available.
  const std::vector<double>& GetPublishedSteps() const { return this->Published; }

private:
  bool IsPushed = false;
  bool TargetMoves = false;
  bool OnlyForward = false;
  std::vector<double> Requested;  // times, in situ
  std::vector<double> InputSteps; // all steps of the target, even a single one
  std::vector<double> Steps;
  std::vector<double> Published;
};

}

#endif
