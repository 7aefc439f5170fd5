#include "Pipeline/StateAttachment.h"

#include "AttachedData.h"
#include "Pipeline/PublishedInformation.h"
#include "Simulation/SurfaceSimulation.h"

#include "vtkDataObject.h"
#include "vtkPointData.h"

#include <memory>

namespace activesurface
{

void AttachState(const SurfaceSimulation& simulation, vtkDataObject* data, vtkPointData* arrays)
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
  Attach(data->GetInformation(), attached);
}

}
