#include "Pipeline/FilterProperties.h"

#include "vtkActiveImplicitSurface.h"
#include "vtkImplicitFunction.h"

#include <algorithm>

namespace activesurface
{

namespace
{

void ReadTarget(vtkActiveImplicitSurface* filter, SurfaceSettings& settings)
{
  settings.TargetFunction = filter->GetTargetFunction();
  settings.TargetStamp = settings.TargetFunction ? settings.TargetFunction->GetMTime() : 0;
  settings.InitialFunction = filter->GetInitialFunction();
  settings.InitialStamp = settings.InitialFunction ? settings.InitialFunction->GetMTime() : 0;
  settings.Particles.Radius = filter->GetParticleRadius();
  settings.Particles.Threshold = filter->GetParticleThreshold();
  settings.Particles.Kernel = static_cast<SkeletonKernel>(filter->GetParticleKernel());
  settings.MeshThickness = filter->GetMeshThickness();
  settings.IsoValue = filter->GetTargetIsoValue();
  settings.Invert = filter->GetInvertTarget() != 0;
  settings.Normalize = filter->GetNormalizeTarget() != 0;
  settings.Reach = filter->GetTargetReach();
}

Motion ReadMotion(vtkActiveImplicitSurface* filter)
{
  Motion motion;
  motion.Attraction = filter->GetAttraction();
  motion.Tension = filter->GetTension();
  motion.CFL = filter->GetCFL();
  motion.AreaControl = static_cast<Control>(filter->GetAreaControl());
  motion.VolumeControl = static_cast<Control>(filter->GetVolumeControl());
  motion.AreaStiffness = filter->GetAreaStiffness();
  motion.VolumeStiffness = filter->GetVolumeStiffness();
  motion.TargetArea = filter->GetTargetArea();
  motion.TargetVolume = filter->GetTargetVolume();
  motion.Evaluation = static_cast<TargetEvaluation>(filter->GetTargetEvaluation());
  motion.Gradient = static_cast<GradientScheme>(filter->GetGradientScheme());
  motion.Paper = filter->GetPaperScheme() != 0;
  return motion;
}

}

SurfaceSettings ReadProperties(vtkActiveImplicitSurface* filter)
{
  constexpr double unset[6] = { 1.0, -1.0, 1.0, -1.0, 1.0, -1.0 };
  SurfaceSettings settings;
  ReadTarget(filter, settings);
  settings.VoxelSize = filter->GetVoxelSize();
  filter->GetModelBounds(settings.Bounds.data());
  settings.BoundsGiven = !std::equal(unset, unset + 6, settings.Bounds.data());
  settings.Bounded = filter->GetBoundedDomain() != 0;
  settings.Strategy = ReadMotion(filter);
  settings.Settles = filter->GetEvolutionMode() == vtkActiveMotionAlgorithm::EQUILIBRIUM;
  settings.Rest.Tolerance = filter->GetRestTolerance();
  settings.Rest.MaximumSubsteps = static_cast<std::size_t>(filter->GetMaximumNumberOfSubsteps());
  settings.TimeScale = filter->GetTimeScale();
  return settings;
}

}
