// An arbitrary vtkPolyData (FuzzData.h) as the target of a skin, and as its initial shape.

#include "FuzzData.h"

#include "vtkActiveImplicitSurface.h"

using namespace activesurface;

namespace
{

void SetProperties(FuzzInput& input, vtkActiveImplicitSurface* surface)
{
  const int choices = input.Take<std::uint8_t>();
  surface->SetVoxelSize(0.5);
  surface->SetMaximumNumberOfActiveVoxels(2000);
  surface->SetNumberOfThreads(1);
  surface->SetParticleModel(choices % 3);
  surface->SetParticleSpacing(choices & 4 ? 0.4 : 0.0);
  surface->SetMeshThickness(choices & 8 ? 0.5 : 0.0);
  surface->SetPassTargetArrays(choices & 16);
  surface->SetComputeVelocity(choices & 32);
  surface->SetTimeIntegration(choices & 64 ? 1 : 0);
  for (int i = 0; i < 3; ++i)
  {
    if (input.Below(4) == 0)
    {
      surface->SetInputArrayToProcess(i, 0, 0, 0, ArrayNames[i]);
    }
  }
}

}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size)
{
  vtkObject::GlobalWarningDisplayOff();
  FuzzInput input(bytes, size);
  vtkNew<vtkActiveImplicitSurface> surface;
  SetProperties(input, surface);
  const bool hasInitial = input.Below(4) == 0;
  surface->SetInputDataObject(0, MakeData(input));
  if (hasInitial)
  {
    surface->SetInputDataObject(1, MakeData(input));
  }
  surface->UpdateTimeStep(0.1);
  return 0;
}
