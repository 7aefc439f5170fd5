// The time steps of a filter: those of its target, or its own.
//
// In situ the target's steps are not all known. Either its list of time steps grows, or it says
// that no time can be had twice (VTK 9.4 and later); then the steps are the times that were
// requested. Or its frames are pushed (PushedFrames.h); then they are the times of the frames.

#ifndef InputClock_h
#define InputClock_h

#include "Simulation/SurfaceSettings.h"

#include <vector>

class vtkInformation;

namespace activesurface
{

// The filter's own clock, for a target without time steps.
struct ClockProperties
{
  double StartTime = 0.0; // pipeline time, as TimeStepSize
  double TimeStepSize = 0.1;
  int NumberOfTimeSteps = 11;
};

class InputClock
{
public:
  // From the filter's properties and what the target says; null: there is none.
  void Read(const ClockProperties& properties, bool isEquilibrium, vtkInformation* target);
  // Of frames that are pushed.
  void Read(const std::vector<double>& pushed);

  // Before data for a time are requested. Whether all that was before is to be forgotten.
  bool Request(vtkInformation* target, double time);

  // Whether the steps are those of pushed frames, and the newest of them.
  bool ArePushed() const { return this->IsPushed; }
  PipelineTime GetNewest() const { return { this->Steps.back() }; }

  // TargetMoves, OnlyForward, Steps and InputSteps.
  void WriteTo(SurfaceInputs& inputs) const;

  // The TIME_STEPS to publish. Empty for an in-situ source until a time has been requested, and
  // over pushed frames, of which only the newest can be had.
  const std::vector<double>& GetPublishedSteps() const { return this->Published; }

private:
  bool IsPushed = false;
  bool TargetMoves = false;
  bool OnlyForward = false;
  std::vector<double> Requested;  // in situ
  std::vector<double> InputSteps; // all, even if only one
  std::vector<double> Steps;
  std::vector<double> Published;
};

}

#endif
