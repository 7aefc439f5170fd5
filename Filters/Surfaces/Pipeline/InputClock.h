// The time steps of a filter: those of its target, or its own.
//
// In situ the target's steps are not all known. Either its list of time steps grows, or it says
// that no time can be had twice (VTK 9.4 and later); then the steps are the times that were
// requested.

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

  // Before data for a time are requested. Whether all that was before is to be forgotten.
  bool Request(vtkInformation* target, double time);

  // TargetMoves, OnlyForward, Steps and InputSteps.
  void WriteTo(SurfaceInputs& inputs) const;

  // The TIME_STEPS to publish. Empty for an in-situ source until a time has been requested.
  const std::vector<double>& GetPublishedSteps() const { return this->Published; }

private:
  bool TargetMoves = false;
  bool OnlyForward = false;
  std::vector<double> Requested;  // in situ
  std::vector<double> InputSteps; // all, even if only one
  std::vector<double> Steps;
  std::vector<double> Published;
};

}

#endif
