#include "Pipeline/StateAttachment.h"

#include "Input/AttachedData.h"
#include "NarrowBand.h"
#include "Pipeline/PublishedInformation.h"
#include "Pipeline/SkinArrays.h"
#include "Pipeline/SurfaceOutput.h"
#include "Pipeline/SurfaceProperties.h"
#include "Simulation/SurfaceSimulation.h"

#include "vtkDataObject.h"
#include "vtkFloatArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <memory>

namespace activesurface
{

namespace
{

// Gathers the state of all ranks, with the skin's arrays that need no particles. Null on ranks that
// do not receive the whole band. Collective.
std::shared_ptr<const AttachedState> GatherState(
  const AttachedState& part, bool normals, bool curvature)
{
  const std::shared_ptr<const NarrowBand> band = part.Skin->GatherWhole(false);
  if (!band)
  {
    return nullptr;
  }
  auto whole = std::make_shared<AttachedState>(part);
  whole->State.Band = whole->Skin = band;
  vtkNew<vtkPolyData> skin;
  vtkNew<vtkFloatArray> array;
  FillSkin(*band, normals ? array.Get() : nullptr, skin);
  whole->WholeArrays = skin->GetPointData();
  if (normals)
  {
    whole->WholeArrays->SetNormals(array);
  }
  if (curvature)
  {
    whole->WholeArrays->AddArray(MakeCurvature(*band));
  }
  return whole;
}

}

void AttachState(const OutputProperties& properties, const SurfaceSimulation& simulation,
  vtkDataObject* data, vtkPointData* arrays)
{
  const SurfaceSettings& settings = simulation.GetSettings();
  const RequestedTime& time = simulation.GetRequestedTime();
  PublishTime(data, time.Time, settings.IsEquilibrium());
  auto attached = std::make_shared<AttachedState>();
  attached->State.Band = simulation.ShareWholeBand();
  attached->Skin = simulation.ShareBand();
  attached->State.Origin = simulation.GetOrigin();
  attached->State.Time = time.Time.Value;
  attached->State.History = simulation.GetHistory();
  attached->WholeArrays = arrays;
  attached->IsAtStep = simulation.IsAtStep();
  attached->Step = time.Step;
  attached->Motion = settings.ListForFiles();
  if (attached->Skin->GetPart())
  {
    attached->Gather = [part = *attached, properties]
    { return GatherState(part, properties.Normals, properties.Curvature); };
  }
  Attach(data->GetInformation(), attached);
}

}
