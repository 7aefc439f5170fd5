// What a request fills of the outputs, and with what.

#include "Pipeline/OutputState.h"
#include "Pipeline/PublishedInformation.h"
#include "Pipeline/SkinPort.h"
#include "Pipeline/SurfaceOutput.h"
#include "Pipeline/SurfaceRequests.h"
#include "Simulation/SurfaceHistory.h"
#include "vtkActiveImplicitSurface.h"

#include "vtkDataObject.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"

namespace activesurface
{

// The history comes along with the others, but not with other pieces of the image.
bool SurfaceRequests::Makes(int port, vtkInformation* request, vtkInformationVector* output) const
{
  const int asked = AskedPort(request);
  return port == asked ||
    (port == HistoryPort && !IsOtherPiece(output->GetInformationObject(asked))) ||
    (port == PotentialPort && this->Filter->GetOutputPotential());
}

void SurfaceRequests::MarkNotMade(vtkInformation* request, vtkInformationVector* output) const
{
  for (int port = SkinPort; port <= HistoryPort; ++port)
  {
    if (!this->Makes(port, request, output))
    {
      output->GetInformationObject(port)->Set(vtkDemandDrivenPipeline::DATA_NOT_GENERATED(), 1);
    }
  }
}

void SurfaceRequests::Fill(int port, vtkInformation* image, vtkDataObject* data)
{
  switch (port)
  {
    case SkinPort:
      FillSkinPort(this->Filter, this->Simulation, vtkPolyData::SafeDownCast(data));
      break;
    case PotentialPort:
      AskForSomeExtent(image);
      FillPotential(this->Simulation.GetBand(),
        image->Get(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT()),
        vtkImageData::SafeDownCast(data));
      break;
    default:
      FillHistory(this->Simulation.GetHistory(), vtkTable::SafeDownCast(data));
  }
}

void SurfaceRequests::FillOutputs(vtkInformation* request, vtkInformationVector* output)
{
  // The extent may be known since now only.
  vtkInformation* image = output->GetInformationObject(PotentialPort);
  PublishExtent(image, this->Simulation.FindDomain());
  for (int port = SkinPort; port <= HistoryPort; ++port)
  {
    if (this->Makes(port, request, output))
    {
      vtkDataObject* data = vtkDataObject::GetData(output, port);
      this->Fill(port, image, data);
      PublishState(this->Filter, this->Simulation, data);
    }
  }
  this->Function.Renew(&this->Simulation.GetBand());
}

void SurfaceRequests::GiveUp(vtkInformationVector* output)
{
  this->Function.Renew(nullptr);
  for (int port = SkinPort; port <= HistoryPort; ++port)
  {
    vtkInformation* out = output->GetInformationObject(port);
    vtkDataObject::GetData(out)->Initialize();
    out->Set(vtkDemandDrivenPipeline::DATA_NOT_GENERATED(), 1);
  }
}

}
