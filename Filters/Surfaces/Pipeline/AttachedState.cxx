#include "Pipeline/AttachedState.h"

#include "CarriedData.h"
#include "Pipeline/PublishedInformation.h"
#include "Simulation/SurfaceSimulation.h"

#include "vtkDataObject.h"

#include <memory>

namespace activesurface
{

void AttachState(const SurfaceSimulation& simulation, vtkDataObject* data)
{
  const SurfaceSettings& settings = simulation.GetSettings();
  const RequestedTime& time = simulation.GetRequestedTime();
  PublishTime(data, time.Time, settings.IsEquilibrium());
  auto carried = std::make_shared<CarriedState>();
  carried->State.Band = simulation.ShareBand();
  carried->State.Time = time.Time.Value;
  carried->State.History = WriteHistory(simulation.GetHistory());
  carried->IsAtStep = simulation.IsAtStep();
  carried->Step = time.Step;
  carried->Motion = settings.ListForFiles();
  Carry(data->GetInformation(), carried);
}

}
