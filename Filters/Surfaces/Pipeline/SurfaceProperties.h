// What the filter's properties say, as its pipeline requests need it.

#ifndef SurfaceProperties_h
#define SurfaceProperties_h

#include "Pipeline/InputClock.h"
#include "Simulation/SurfaceSimulation.h"

namespace activesurface
{

struct SurfaceProperties
{
  SurfaceSettings Settings; // but for the inputs, of which it has the functions alone
  ClockProperties Clock;
  SimulationLimits Limits;

  bool Normals = true;
  bool Curvature = false;
  bool Velocity = false;
  bool TangentialVelocity = false;
  bool PassTargetArrays = false;
  bool OutputPotential = false;
};

}

#endif
