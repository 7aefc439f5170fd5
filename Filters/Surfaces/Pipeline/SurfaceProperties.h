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

// Calls visit for each of OutputProperties, as ForEachMotionProperty does.
template <class Properties, class Visitor>
void ForEachOutputProperty(Properties& outputs, Visitor&& visit)
{
  using namespace ranges;
  visit(Property{ "ComputeNormals", Any, false }, outputs.Normals,
    [](auto& filter) { return filter.GetComputeNormals(); });
  visit(Property{ "ComputeVelocity", Any, false }, outputs.Velocity,
    [](auto& filter) { return filter.GetComputeVelocity(); });
  visit(Property{ "TangentialVelocity", Any, false }, outputs.TangentialVelocity,
    [](auto& filter) { return filter.GetTangentialVelocity(); });
  visit(Property{ "MaximumVelocity",
          OrZero("a finite number > 0, or 0 for the speed of the fastest particle"), false },
    outputs.MaximumVelocity, [](auto& filter) { return filter.GetMaximumVelocity(); });
  visit(Property{ "ComputeCurvature", Any, false }, outputs.Curvature,
    [](auto& filter) { return filter.GetComputeCurvature(); });
  visit(Property{ "PassTargetArrays", Any, false }, outputs.PassTargetArrays,
    [](auto& filter) { return filter.GetPassTargetArrays(); });
  visit(Property{ "OutputPotential", Any, false }, outputs.Potential,
    [](auto& filter) { return filter.GetOutputPotential(); });
}

}

#endif
