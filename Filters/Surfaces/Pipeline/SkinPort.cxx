#include "Pipeline/SkinPort.h"

#include "Pipeline/SurfaceInput.h"
#include "Pipeline/SurfaceOutput.h"
#include "SkinMotion.h"
#include "vtkActiveImplicitSurface.h"

#include "vtkFloatArray.h"
#include "vtkPolyData.h"

namespace activesurface
{

SkinWishes ReadWishes(vtkActiveImplicitSurface* filter, const SurfaceInput& target)
{
  SkinWishes wishes;
  wishes.Speeds = filter->GetComputeVelocity() != 0;
  wishes.Drift = wishes.Speeds && filter->GetTangentialVelocity() != 0;
  wishes.Arrays = filter->GetPassTargetArrays() != 0;
  if (wishes.Arrays || wishes.Drift)
  {
    wishes.Kept = target.DescribeParticleArrays(wishes.Arrays, wishes.Drift);
  }
  return wishes;
}

void FillSkinPort(
  vtkActiveImplicitSurface* filter, SurfaceSimulation& simulation, vtkPolyData* skin)
{
  const NarrowBand& band = simulation.GetBand();
  SkinArrays arrays;
  arrays.Normals = filter->GetComputeNormals() != 0;
  std::vector<float> curvatures, speeds;
  if (filter->GetComputeCurvature())
  {
    curvatures = FindCurvatures(band);
    arrays.Curvatures = &curvatures;
  }
  if (filter->GetComputeVelocity())
  {
    speeds = simulation.GetSpeeds();
    arrays.Speeds = &speeds;
  }
  const vtkSmartPointer<vtkFloatArray> directions = FillSkin(band, arrays, skin);
  const PassedArrays passed = simulation.GetPassedArrays();
  band.Run([&passed, &directions, skin] { PassArrays(passed, directions, skin); });
}

}
