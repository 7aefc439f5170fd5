// Requests time steps of the target's input: one missing step in the usual pipeline pass, further
// steps by updates of the input.

#ifndef TargetSteps_h
#define TargetSteps_h

#include "Pipeline/SurfaceInput.h"
#include "Simulation/SurfaceSimulation.h"

#include <memory>

class vtkInformation;

namespace activesurface
{

class TargetSteps
{
public:
  // The caller owns the arguments.
  TargetSteps(SurfaceInput& target, SurfaceSimulation& simulation)
    : Target(target)
    , Simulation(simulation)
  {
  }

  // Requests the next missing step. Requests another step if none is missing, or if the last update
  // failed (of a forward-only input: if the missing step is not the newest). Call this when the
  // inputs are requested.
  void Request(vtkInformation* target);

  // Returns true if Request has requested the first time step.
  bool IsAtFirst() const { return this->RequestedFirst; }

  // Adds the requested step to the simulation if that step is still missing. target: null if there
  // is no input.
  void AddRequested(vtkInformation* target);

  // Adds the first step. If this step has particles or no points, reads up to two more steps to
  // estimate the particle spacing. Collective.
  void SettleSpacing(vtkInformation* target, Agreement& ranks);

  // Adds the input's current data as the first step, if this step is still missing.
  void AddFirst(vtkInformation* target);

  // Updates the input to a step, and returns the step. Throws std::runtime_error if the update
  // fails, or if mayGoBack is false: the input provides each step only once.
  std::shared_ptr<InputShape> Make(vtkInformation* target, int step, bool mayGoBack);

  // Returns the current data of the input.
  std::shared_ptr<InputShape> Read(vtkInformation* target) const;

private:
  enum
  {
    NoStep = -1
  };

  int FindStepBeside(int missing) const;

  SurfaceInput& Target;
  SurfaceSimulation& Simulation;
  int Requested = NoStep;        // step of the simulation
  bool RequestedFirst = false;   // time step of the input
  bool LastUpdateFailed = false; // or has not returned yet
};

}

#endif
