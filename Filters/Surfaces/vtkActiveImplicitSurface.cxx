#include "vtkActiveImplicitSurface.h"

#include "SurfaceRequests.h"

#include "vtkDataObject.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkGarbageCollector.h"
#include "vtkGridPotential.h"
#include "vtkImageData.h"
#include "vtkImplicitFunction.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkSkeletonPotential.h"
#include "vtkTable.h"

#include <algorithm>
#include <exception>
#include <new>

using activesurface::SurfaceRequests;

vtkStandardNewMacro(vtkActiveImplicitSurface);

vtkActiveImplicitSurface::vtkActiveImplicitSurface()
  : Requests(std::make_unique<SurfaceRequests>(this))
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(3);
  // No radii; the base class has chosen the active scalars.
  this->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "");
  this->Requests->GetSimulation().SetWarning(
    [this](const std::string& sentence) { vtkWarningMacro(<< sentence); });
}

vtkActiveImplicitSurface::~vtkActiveImplicitSurface() = default;

void vtkActiveImplicitSurface::SetTargetFunction(vtkImplicitFunction* function)
{
  if (this->TargetFunction != function)
  {
    this->TargetFunction = function;
    this->Modified();
  }
}

vtkImplicitFunction* vtkActiveImplicitSurface::GetTargetFunction()
{
  return this->TargetFunction;
}

void vtkActiveImplicitSurface::SetInitialFunction(vtkImplicitFunction* function)
{
  if (this->InitialFunction != function)
  {
    this->InitialFunction = function;
    this->Modified();
  }
}

vtkImplicitFunction* vtkActiveImplicitSurface::GetInitialFunction()
{
  return this->InitialFunction;
}

void vtkActiveImplicitSurface::SetParticleKernelToWyvill()
{
  this->SetParticleKernel(vtkSkeletonPotential::WYVILL);
}

void vtkActiveImplicitSurface::SetParticleKernelToCubicSpline()
{
  this->SetParticleKernel(vtkSkeletonPotential::CUBIC_SPLINE);
}

void vtkActiveImplicitSurface::SetParticleKernelToMetaball()
{
  this->SetParticleKernel(vtkSkeletonPotential::METABALL);
}

vtkIdType vtkActiveImplicitSurface::GetTargetEvaluations()
{
  return static_cast<vtkIdType>(this->Requests->GetSimulation().GetTargetEvaluations());
}

vtkIdType vtkActiveImplicitSurface::GetSubsteps()
{
  return static_cast<vtkIdType>(this->Requests->GetSimulation().GetSubsteps());
}

void vtkActiveImplicitSurface::ResetCounters()
{
  this->Requests->GetSimulation().ResetCounters();
}

vtkPolyData* vtkActiveImplicitSurface::GetOutput()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(SurfaceRequests::SkinPort));
}

vtkImageData* vtkActiveImplicitSurface::GetPotential()
{
  return vtkImageData::SafeDownCast(this->GetOutputDataObject(SurfaceRequests::PotentialPort));
}

vtkTable* vtkActiveImplicitSurface::GetHistory()
{
  return vtkTable::SafeDownCast(this->GetOutputDataObject(SurfaceRequests::HistoryPort));
}

vtkImplicitFunction* vtkActiveImplicitSurface::GetSkinFunction()
{
  return this->Requests->GetSkinFunction();
}

bool vtkActiveImplicitSurface::SaveState(const char* file)
{
  try
  {
    this->Requests->SaveState(file ? file : "");
    return true;
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
    return false;
  }
}

bool vtkActiveImplicitSurface::LoadState(const char* file)
{
  try
  {
    this->Requests->LoadState(file ? file : "");
    this->Modified();
    return true;
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
    return false;
  }
}

void vtkActiveImplicitSurface::PaperFaithful()
{
  this->SetPaperScheme(true);
  this->SetTargetEvaluation(SHIFTED);
  this->SetGradientScheme(CENTRAL);
  this->SetNormalizeTarget(false);
}

vtkMTimeType vtkActiveImplicitSurface::GetMTime()
{
  vtkMTimeType time = this->Superclass::GetMTime();
  for (vtkImplicitFunction* function : { this->GetTargetFunction(), this->GetInitialFunction() })
  {
    time = function ? std::max(time, function->GetMTime()) : time;
  }
  return time;
}

void vtkActiveImplicitSurface::ReportReferences(vtkGarbageCollector* collector)
{
  this->Superclass::ReportReferences(collector);
  vtkGarbageCollectorReport(collector, this->TargetFunction, "TargetFunction");
  vtkGarbageCollectorReport(collector, this->InitialFunction, "InitialFunction");
}

int vtkActiveImplicitSurface::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPointSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

int vtkActiveImplicitSurface::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(),
    port == SurfaceRequests::SkinPort          ? "vtkPolyData"
      : port == SurfaceRequests::PotentialPort ? "vtkImageData"
                                               : "vtkTable");
  return 1;
}

vtkTypeBool vtkActiveImplicitSurface::ProcessRequest(
  vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output)
{
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_NOT_GENERATED()))
  {
    this->Requests->MarkNotMade(request, output);
    return 1;
  }
  return this->Superclass::ProcessRequest(request, input, output);
}

int vtkActiveImplicitSurface::RequestInformation(
  vtkInformation*, vtkInformationVector** input, vtkInformationVector* output)
{
  this->Requests->PublishInformation(input, output);
  return 1;
}

int vtkActiveImplicitSurface::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output)
{
  this->Requests->AskInputs(request, input, output);
  return 1;
}

int vtkActiveImplicitSurface::RequestData(
  vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output)
{
  try
  {
    this->Requests->Make(request, input, output);
    return 1;
  }
  catch (const std::bad_alloc&)
  {
    this->Requests->GetSimulation().Drop();
    this->Requests->GiveUp(output);
    vtkErrorMacro(<< "There is not enough memory for the skin, or for the potential's image, whose "
                     "size is that of ModelBounds; enlarge VoxelSize or shrink ModelBounds.");
    return 0;
  }
  catch (const std::exception& error)
  {
    this->Requests->GiveUp(output);
    vtkErrorMacro(<< error.what());
    return 0;
  }
}

void vtkActiveImplicitSurface::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const double* b = this->ModelBounds;
  os << indent << "TargetFunction: " << this->TargetFunction << "\n"
     << indent << "InitialFunction: " << this->InitialFunction << "\n"
     << indent << "TargetIsoValue: " << this->TargetIsoValue << "\n"
     << indent << "InvertTarget: " << this->InvertTarget << "\n"
     << indent << "NormalizeTarget: " << this->NormalizeTarget << "\n"
     << indent << "TargetReach: " << this->TargetReach << "\n"
     << indent << "VoxelSize: " << this->VoxelSize << "\n"
     << indent << "ModelBounds: " << b[0] << " " << b[1] << " " << b[2] << " " << b[3] << " "
     << b[4] << " " << b[5] << "\n"
     << indent << "BoundedDomain: " << this->BoundedDomain << "\n"
     << indent << "ParticleRadius: " << this->ParticleRadius << "\n"
     << indent << "ParticleKernel: " << this->ParticleKernel << "\n"
     << indent << "ParticleThreshold: " << this->ParticleThreshold << "\n"
     << indent << "MeshThickness: " << this->MeshThickness << "\n"
     << indent << "ComputeNormals: " << this->ComputeNormals << "\n"
     << indent << "ComputeVelocity: " << this->ComputeVelocity << "\n"
     << indent << "TangentialVelocity: " << this->TangentialVelocity << "\n"
     << indent << "MaximumVelocity: " << this->MaximumVelocity << "\n"
     << indent << "PassTargetArrays: " << this->PassTargetArrays << "\n"
     << indent << "ComputeCurvature: " << this->ComputeCurvature << "\n"
     << indent << "OutputPotential: " << this->OutputPotential << "\n";
}
