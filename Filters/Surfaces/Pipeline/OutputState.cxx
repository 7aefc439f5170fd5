#include "Pipeline/OutputState.h"

#include "CarriedData.h"
#include "Pipeline/PublishedInformation.h"
#include "Simulation/StateFile.h"
#include "Simulation/SurfaceSimulation.h"
#include "vtkActiveImplicitSurface.h"

#include "vtkDataObject.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace activesurface
{

namespace
{

// Each by the name of the filter's property.
std::vector<std::pair<std::string, double>> ListMotion(
  vtkActiveImplicitSurface* filter, const SurfaceSettings& settings)
{
  const Motion& motion = settings.Strategy;
  return { { "Attraction", motion.Attraction }, { "Tension", motion.Tension },
    { "CFL", motion.CFL }, { "AreaControl", static_cast<double>(motion.AreaControl) },
    { "VolumeControl", static_cast<double>(motion.VolumeControl) },
    { "AreaStiffness", motion.AreaStiffness }, { "VolumeStiffness", motion.VolumeStiffness },
    { "TargetArea", motion.TargetArea }, { "TargetVolume", motion.TargetVolume },
    { "TargetEvaluation", static_cast<double>(motion.Evaluation) },
    { "GradientScheme", static_cast<double>(motion.Gradient) },
    { "PaperScheme", static_cast<double>(motion.Paper) },
    { "EvolutionMode", static_cast<double>(filter->GetEvolutionMode()) },
    { "RestTolerance", settings.Rest.Tolerance },
    { "MaximumNumberOfSubsteps", static_cast<double>(settings.Rest.MaximumSubsteps) },
    { "TimeScale", settings.TimeScale }, { "TargetIsoValue", settings.IsoValue },
    { "InvertTarget", static_cast<double>(settings.Invert) },
    { "NormalizeTarget", static_cast<double>(settings.Normalize) },
    { "TargetReach", settings.Reach }, { "BoundedDomain", static_cast<double>(settings.Bounded) },
    { "ParticleRadius", settings.Particles.Radius },
    { "ParticleThreshold", settings.Particles.Threshold },
    { "ParticleKernel", static_cast<double>(settings.Particles.Kernel) },
    { "MeshThickness", settings.MeshThickness } };
}

}

void PublishState(
  vtkActiveImplicitSurface* filter, const SurfaceSimulation& simulation, vtkDataObject* data)
{
  const SurfaceSettings& settings = simulation.GetSettings();
  PublishTime(data, simulation.GetGoalTime(), settings.Settles);
  auto carried = std::make_shared<CarriedState>();
  carried->State.Band = simulation.ShareBand();
  carried->State.Time = simulation.GetGoalTime();
  carried->State.History = WriteHistory(simulation.GetHistory());
  carried->IsAtStep = simulation.IsAtStep();
  carried->Step = simulation.GetGoalStep();
  carried->Motion = ListMotion(filter, settings);
  Carry(data->GetInformation(), carried);
}

}
