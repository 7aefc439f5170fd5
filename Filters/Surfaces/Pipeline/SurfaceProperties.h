// Values of the filter's properties, for its pipeline requests.

#ifndef SurfaceProperties_h
#define SurfaceProperties_h

#include "Pipeline/InputClock.h"
#include "Pipeline/OutputShare.h"
#include "Simulation/SurfaceSimulation.h"

namespace activesurface
{

// Contents of the outputs besides the shape of the skin. Changes do not restart the motion.
struct OutputProperties
{
  bool Normals = true;
  bool Velocity = false;
  bool TangentialVelocity = false;
  double MaximumVelocity = 0.0; // 0: the speed of the fastest particle
  bool Curvature = false;
  bool PassTargetArrays = false;
  bool Potential = false;
};

struct SurfaceProperties
{
  SurfaceSettings Settings; // of the inputs only the functions are set
  ClockProperties Clock;
  SimulationLimits Limits;
  OutputProperties Outputs;
  OutputShare Share;
};

// Calls visit for each property of the outputs, as ForEachProperty does.
template <class Properties, class Visitor>
void ForEachOutputProperty(Properties& outputs, Visitor&& visit)
{
  using namespace ranges;
  ACTIVE_PROPERTY(ComputeNormals, outputs.Normals, Any);
  ACTIVE_PROPERTY(ComputeVelocity, outputs.Velocity, Any);
  ACTIVE_PROPERTY(TangentialVelocity, outputs.TangentialVelocity, Any);
  ACTIVE_PROPERTY(MaximumVelocity, outputs.MaximumVelocity,
    OrZero("a finite number > 0, or 0 for the speed of the fastest particle"));
  ACTIVE_PROPERTY(ComputeCurvature, outputs.Curvature, Any);
  ACTIVE_PROPERTY(PassTargetArrays, outputs.PassTargetArrays, Any);
  ACTIVE_PROPERTY(OutputPotential, outputs.Potential, Any);
}

// Calls visit for each limit that has to be the same on all ranks.
template <class Limits, class Visitor>
void ForEachLimit(Limits& limits, Visitor&& visit)
{
  using namespace ranges;
  ACTIVE_PROPERTY(CheckpointInterval, limits.CheckpointInterval, Any);
  ACTIVE_PROPERTY(CheckpointMemory, limits.CheckpointMemory, Any);
  ACTIVE_PROPERTY(MaximumNumberOfActiveVoxels, limits.MaximumVoxels, Any);
}

// Calls visit for all properties except functions and the controller.
template <class Properties, class Visitor>
void ForEachOfAll(Properties& properties, Visitor&& visit)
{
  using namespace ranges;
  ForEachProperty(properties.Settings, visit);
  ACTIVE_PROPERTY(StartTime, properties.Clock.StartTime, Any);
  ACTIVE_PROPERTY(TimeStepSize, properties.Clock.TimeStepSize, Any);
  ACTIVE_PROPERTY(NumberOfTimeSteps, properties.Clock.NumberOfTimeSteps, Any);
  ForEachOutputProperty(properties.Outputs, visit);
  ForEachLimit(properties.Limits, visit);
  ACTIVE_PROPERTY(NumberOfThreads, properties.Limits.Threads, Any);
}

}

#endif
