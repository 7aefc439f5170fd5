#include "Pipeline/OutputPorts.h"

#include "Pipeline/PublishedInformation.h"
#include "Pipeline/SkinArrays.h"
#include "Pipeline/SkinShare.h"
#include "Pipeline/StateAttachment.h"
#include "Pipeline/SurfaceOutput.h"

#include "vtkDataObject.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"

namespace activesurface
{

namespace
{

// The history is filled along with each requested port. Exception: on one process, not with a piece
// other than piece 0.
bool IsFilled(int port, const SurfaceProperties& properties, vtkInformation* request,
  vtkInformationVector* output)
{
  const int requested = RequestedPort(request);
  const bool isWithHistory =
    !properties.Share.IsAll() || !IsOtherPiece(output->GetInformationObject(requested));
  return port == requested || (port == OutputPorts::History && isWithHistory) ||
    (port == OutputPorts::Potential && properties.Outputs.Potential);
}

void FillSkinPort(
  const OutputProperties& properties, const SurfaceSimulation& simulation, vtkPolyData* skin)
{
  vtkNew<vtkFloatArray> normals;
  normals->SetNumberOfComponents(3);
  const bool areNeeded = properties.Normals || NeedNormals(properties);
  FillSkin(simulation.GetBand(), areNeeded ? normals.Get() : nullptr, skin);
  if (properties.Normals)
  {
    skin->GetPointData()->SetNormals(normals);
  }
  AddSkinArrays(properties, simulation, normals, skin);
  MoveToWorld(simulation.GetOrigin(), skin);
}

void FillPort(int port, const SurfaceProperties& properties, const SurfaceSimulation& simulation,
  vtkInformation* output, vtkDataObject* data)
{
  switch (port)
  {
    case OutputPorts::Skin:
      FillSkinPort(properties.Outputs, simulation, vtkPolyData::SafeDownCast(data));
      break;
    case OutputPorts::Potential:
      RequestSomeExtent(output, properties.Share);
      FillPotential(simulation.GetBand(),
        output->Get(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT()), simulation.GetOrigin(),
        vtkImageData::SafeDownCast(data));
      break;
    default:
      FillHistory(properties.Share.Rank == 0 ? simulation.GetHistory() : std::vector<HistoryRow>(),
        vtkTable::SafeDownCast(data));
  }
}

}

bool OutputPorts::IsForNothing(
  const OutputShare& share, vtkInformation* request, vtkInformationVector* output)
{
  const int port = RequestedPort(request);
  return share.IsAll() && port != Potential && IsOtherPiece(output->GetInformationObject(port));
}

void OutputPorts::MarkUnfilled(
  const SurfaceProperties& properties, vtkInformation* request, vtkInformationVector* output)
{
  for (int port = 0; port < NumberOfPorts; ++port)
  {
    if (!IsFilled(port, properties, request, output))
    {
      output->GetInformationObject(port)->Set(vtkDemandDrivenPipeline::DATA_NOT_GENERATED(), 1);
    }
  }
}

void OutputPorts::Fill(const SurfaceProperties& properties, SurfaceSimulation& simulation,
  vtkInformation* request, vtkInformationVector* output)
{
  // The domain may not have been available before.
  PublishExtent(output->GetInformationObject(Potential), simulation.FindDomain());
  for (int port = 0; port < NumberOfPorts; ++port)
  {
    if (IsFilled(port, properties, request, output))
    {
      vtkDataObject* data = vtkDataObject::GetData(output, port);
      FillPort(port, properties, simulation, output->GetInformationObject(port), data);
      AttachState(properties.Outputs, simulation, data,
        port == Skin
          ? KeepShare(simulation.GetBand(), properties.Share, vtkPolyData::SafeDownCast(data))
          : nullptr);
    }
  }
  this->AreFilled = true;
  this->Filled = simulation.GetRequestedTime();
  this->Function.Renew(&simulation.GetBand(), simulation.GetOrigin());
}

void OutputPorts::Clear(vtkInformationVector* output)
{
  this->AreFilled = false;
  this->Function.Renew(nullptr, {});
  for (int port = 0; port < NumberOfPorts; ++port)
  {
    vtkInformation* out = output->GetInformationObject(port);
    vtkDataObject::GetData(out)->Initialize();
    out->Set(vtkDemandDrivenPipeline::DATA_NOT_GENERATED(), 1);
  }
}

}
