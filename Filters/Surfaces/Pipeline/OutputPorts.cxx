#include "Pipeline/OutputPorts.h"

#include "Pipeline/PublishedInformation.h"
#include "Pipeline/StateAttachment.h"
#include "Pipeline/SurfaceOutput.h"
#include "SkinMotion.h"

#include "vtkDataObject.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"

namespace activesurface
{

namespace
{

// The history comes along with the others, but not with other pieces of the image.
bool IsFilled(int port, const SurfaceProperties& properties, vtkInformation* request,
  vtkInformationVector* output)
{
  const int requested = RequestedPort(request);
  return port == requested ||
    (port == OutputPorts::History && !IsOtherPiece(output->GetInformationObject(requested))) ||
    (port == OutputPorts::Potential && properties.OutputPotential);
}

void FillSkinPort(
  const SurfaceProperties& properties, SurfaceSimulation& simulation, vtkPolyData* skin)
{
  const NarrowBand& band = simulation.GetBand();
  const SkinAttributes attributes = simulation.FindAttributes();
  SkinArrays arrays;
  arrays.Normals = properties.Normals;
  std::vector<float> curvatures, speeds;
  if (properties.Curvature)
  {
    curvatures = FindCurvatures(band);
    arrays.Curvatures = &curvatures;
  }
  if (properties.Velocity)
  {
    speeds = attributes.FindSpeeds(band, simulation.GetMotion());
    arrays.Speeds = &speeds;
  }
  const vtkSmartPointer<vtkFloatArray> directions = FillSkin(band, arrays, skin);
  const PassedArrays passed = attributes.FindPassedArrays();
  band.Run([&passed, &directions, skin] { PassArrays(passed, directions, skin); });
}

void FillPort(int port, const SurfaceProperties& properties, SurfaceSimulation& simulation,
  vtkInformation* output, vtkDataObject* data)
{
  switch (port)
  {
    case OutputPorts::Skin:
      FillSkinPort(properties, simulation, vtkPolyData::SafeDownCast(data));
      break;
    case OutputPorts::Potential:
      RequestSomeExtent(output);
      FillPotential(simulation.GetBand(),
        output->Get(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT()),
        vtkImageData::SafeDownCast(data));
      break;
    default:
      FillHistory(simulation.GetHistory(), vtkTable::SafeDownCast(data));
  }
}

}

bool OutputPorts::IsForNothing(vtkInformation* request, vtkInformationVector* output)
{
  const int port = RequestedPort(request);
  return port != Potential && IsOtherPiece(output->GetInformationObject(port));
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
  // The extent may be known since now only.
  PublishExtent(output->GetInformationObject(Potential), simulation.FindDomain());
  for (int port = 0; port < NumberOfPorts; ++port)
  {
    if (IsFilled(port, properties, request, output))
    {
      vtkDataObject* data = vtkDataObject::GetData(output, port);
      FillPort(port, properties, simulation, output->GetInformationObject(port), data);
      AttachState(simulation, data);
    }
  }
  this->Function.Renew(&simulation.GetBand());
}

void OutputPorts::Clear(vtkInformationVector* output)
{
  this->Function.Renew(nullptr);
  for (int port = 0; port < NumberOfPorts; ++port)
  {
    vtkInformation* out = output->GetInformationObject(port);
    vtkDataObject::GetData(out)->Initialize();
    out->Set(vtkDemandDrivenPipeline::DATA_NOT_GENERATED(), 1);
  }
}

}
