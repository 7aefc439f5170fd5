// Which time steps the input of the target is asked for: the first one on the pipeline's own way,
// others from within.

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
  // Both are the caller's.
  TargetSteps(SurfaceInput& target, SurfaceSimulation& simulation)
    : Target(target)
    , Simulation(simulation)
  {
  }

  // Asks for the step that the simulation needs first, when the inputs are requested.
  void Request(vtkInformation* target);

  // What has come of it, if it is needed still; null: there is no input.
  void TakeRequested(vtkInformation* target);

  // Reads the first step, and further ones to find the particles' spacing. Collective.
  void SettleSpacing(vtkInformation* target, Agreement& ranks);

  // The first step, which the input has now, unless it was taken.
  void TakeFirst(vtkInformation* target);

  // Another step, by an update from within. Throws std::runtime_error if it cannot be had;
  // mayGoBack: whether one that was made before can.
  std::shared_ptr<InputShape> Make(vtkInformation* target, int step, bool mayGoBack);

  // What the input has now.
  std::shared_ptr<InputShape> Read(vtkInformation* target) const;

private:
  enum
  {
    NoStep = -1
  };

  int FindStepBeside(int missing) const;

  SurfaceInput& Target;
  SurfaceSimulation& Simulation;
  int Requested = NoStep;        // of the simulation's
  bool LastUpdateFailed = false; // or has not come back yet
};

}

#endif
