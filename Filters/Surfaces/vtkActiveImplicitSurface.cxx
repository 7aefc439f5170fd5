#include "vtkActiveImplicitSurface.h"

#include "Pipeline/SurfaceRequests.h"
#include "Ranks/RankedPipeline.h"
#include "Simulation/SurfaceSettings.h"

#include "vtkDataObject.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkExecutive.h"
#include "vtkGarbageCollector.h"
#include "vtkGridPotential.h"
#include "vtkImageData.h"
#include "vtkImplicitFunction.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkSkeletonPotential.h"
#include "vtkTable.h"

#include <algorithm>
#include <exception>
#include <ostream>

namespace activesurface
{
namespace
{

// Copies the value of a property of the filter to its field of the settings.
template <class Value, class Field>
void AssignProperty(const Value& value, Field& field)
{
  field = static_cast<Field>(value);
}

inline void AssignProperty(double* values, std::array<double, 6>& field)
{
  std::copy_n(values, 6, field.begin());
}

template <class Value>
void PrintProperty(std::ostream& os, const Property& property, const Value& value)
{
  os << property.Name << ": " << value << "\n";
}

inline void PrintProperty(std::ostream& os, const Property& property, double* values)
{
  os << property.Name << ":";
  std::for_each(values, values + 6, [&os](double value) { os << " " << value; });
  os << "\n";
}

}
}

using activesurface::OutputPorts;
using activesurface::SurfaceProperties;
using activesurface::SurfaceRequests;

vtkStandardNewMacro(vtkActiveImplicitSurface);

static_assert(static_cast<int>(vtkActiveImplicitSurface::ANISOTROPIC) ==
      static_cast<int>(vtkSkeletonPotential::ANISOTROPIC) &&
    static_cast<int>(vtkActiveImplicitSurface::METABALL) ==
      static_cast<int>(vtkSkeletonPotential::METABALL),
  "The filter's models and kernels are the potential's.");

vtkActiveImplicitSurface::vtkActiveImplicitSurface()
  : Requests(std::make_unique<SurfaceRequests>(this))
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(3);
  // Chooses no array of radii; the base class has chosen the active scalars.
  this->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "");
  this->Requests->GetSimulation().SetWarning(
    [this](activesurface::Warnings::Kind kind, const std::string& sentence)
    {
      if (this->Requests->GetShare().Rank == 0)
      {
        this->Requests->GetMessages().Warn(kind, sentence);
      }
    });
  this->SetController(vtkMultiProcessController::GetGlobalController());
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

void vtkActiveImplicitSurface::SetObstacleFunction(vtkImplicitFunction* function)
{
  if (this->ObstacleFunction != function)
  {
    this->ObstacleFunction = function;
    this->Modified();
  }
}

vtkImplicitFunction* vtkActiveImplicitSurface::GetObstacleFunction()
{
  return this->ObstacleFunction;
}

void vtkActiveImplicitSurface::SetController(vtkMultiProcessController* controller)
{
  if (this->Controller != controller)
  {
    this->Controller = controller;
    this->Requests->SetController(controller);
    this->Modified();
  }
}

vtkMultiProcessController* vtkActiveImplicitSurface::GetController()
{
  return this->Controller;
}

vtkExecutive* vtkActiveImplicitSurface::CreateDefaultExecutive()
{
  return activesurface::RankedPipeline::New();
}

vtkIdType vtkActiveImplicitSurface::GetTargetEvaluations()
{
  return static_cast<vtkIdType>(this->Requests->GetSimulation().GetDriver().GetTargetEvaluations());
}

vtkIdType vtkActiveImplicitSurface::GetSubsteps()
{
  return static_cast<vtkIdType>(this->Requests->GetSimulation().GetDriver().GetSubsteps());
}

void vtkActiveImplicitSurface::ResetCounters()
{
  this->Requests->GetSimulation().ResetCounters();
}

double vtkActiveImplicitSurface::GetVoxelSizeInUse()
{
  return this->Requests->GetSimulation().GetValuesInUse().VoxelSize;
}

double vtkActiveImplicitSurface::GetParticleSpacingInUse()
{
  return this->Requests->GetSimulation().GetValuesInUse().ParticleSpacing;
}

double vtkActiveImplicitSurface::GetKernelRadiusInUse()
{
  return this->Requests->GetSimulation().GetValuesInUse().KernelRadius;
}

double vtkActiveImplicitSurface::GetTargetReachInUse()
{
  return this->Requests->GetSimulation().GetValuesInUse().TargetReach;
}

double vtkActiveImplicitSurface::GetAttractionInUse()
{
  return this->Requests->GetSimulation().GetValuesInUse().Attraction;
}

double vtkActiveImplicitSurface::GetTensionInUse()
{
  return this->Requests->GetSimulation().GetValuesInUse().Tension;
}

double vtkActiveImplicitSurface::GetTargetNoiseInUse()
{
  return this->Requests->GetSimulation().GetValuesInUse().TargetNoise;
}

vtkPolyData* vtkActiveImplicitSurface::GetOutput()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(OutputPorts::Skin));
}

vtkImageData* vtkActiveImplicitSurface::GetPotential()
{
  return vtkImageData::SafeDownCast(this->GetOutputDataObject(OutputPorts::Potential));
}

vtkTable* vtkActiveImplicitSurface::GetHistory()
{
  return vtkTable::SafeDownCast(this->GetOutputDataObject(OutputPorts::History));
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

bool vtkActiveImplicitSurface::Advance(vtkDataObject* frame, double dt)
{
  try
  {
    this->Requests->Push(this->FindProperties(), frame, dt);
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
    return false;
  }
  if (this->GetExecutive()->Update(OutputPorts::Skin) && this->Requests->IsAtNewestFrame())
  {
    return true;
  }
  if (this->Requests->WithdrawFrame())
  {
    this->Update(OutputPorts::Skin);
  }
  return false;
}

void vtkActiveImplicitSurface::ResetTrajectory()
{
  try
  {
    this->Requests->Restart();
    this->Modified();
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
  }
}

void vtkActiveImplicitSurface::PaperFaithful()
{
  this->SetPaperScheme(true);
  this->SetTargetEvaluation(SHIFTED);
  this->SetTimeIntegration(EXPLICIT);
  this->SetGradientScheme(CENTRAL);
  this->SetNormalizeTarget(false);
  this->SetParticleModel(SUM);
}

vtkMTimeType vtkActiveImplicitSurface::GetMTime()
{
  vtkMTimeType time = this->Superclass::GetMTime();
  for (vtkImplicitFunction* function :
    { this->GetTargetFunction(), this->GetInitialFunction(), this->GetObstacleFunction() })
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
  vtkGarbageCollectorReport(collector, this->ObstacleFunction, "ObstacleFunction");
}

int vtkActiveImplicitSurface::FillInputPortInformation(int port, vtkInformation* info)
{
  activesurface::SurfaceInput::DescribePort(port, info);
  return 1;
}

int vtkActiveImplicitSurface::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(),
    port == OutputPorts::Skin          ? "vtkPolyData"
      : port == OutputPorts::Potential ? "vtkImageData"
                                       : "vtkTable");
  return 1;
}

vtkTypeBool vtkActiveImplicitSurface::ProcessRequest(
  vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output)
{
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_NOT_GENERATED()))
  {
    OutputPorts::MarkUnfilled(this->FindProperties(), request, output);
    return 1;
  }
  return this->Superclass::ProcessRequest(request, input, output);
}

int vtkActiveImplicitSurface::RequestInformation(
  vtkInformation*, vtkInformationVector** input, vtkInformationVector* output)
{
  this->Requests->PublishInformation(this->FindProperties(), input, output);
  return 1;
}

int vtkActiveImplicitSurface::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output)
{
  this->Requests->RequestInputs(this->FindProperties(), request, input, output);
  return 1;
}

int vtkActiveImplicitSurface::RequestData(
  vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output)
{
  try
  {
    this->Requests->RequestData(this->FindProperties(), request, input, output);
    this->Requests->GetMessages().ForgetError();
    return 1;
  }
  catch (const std::exception& error)
  {
    this->Requests->ClearOutputs(output);
    return this->Requests->GetMessages().Fail(error.what());
  }
}

SurfaceProperties vtkActiveImplicitSurface::FindProperties()
{
  SurfaceProperties properties;
  activesurface::ForEachOfAll(properties,
    [this](const activesurface::Property&, auto& field, auto&& get)
    { activesurface::AssignProperty(get(*this), field); });
  activesurface::SurfaceInputs& inputs = properties.Settings.Inputs;
  inputs.TargetFunction = this->TargetFunction;
  inputs.TargetMTime = this->TargetFunction ? this->TargetFunction->GetMTime() : 0;
  inputs.InitialFunction = this->InitialFunction;
  inputs.InitialMTime = this->InitialFunction ? this->InitialFunction->GetMTime() : 0;
  inputs.ObstacleFunction = this->ObstacleFunction;
  inputs.ObstacleMTime = this->ObstacleFunction ? this->ObstacleFunction->GetMTime() : 0;
  properties.Share = this->Requests->GetShare();
  return properties;
}

void vtkActiveImplicitSurface::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  SurfaceProperties unused;
  activesurface::ForEachOfAll(unused,
    [&](const activesurface::Property& property, auto&, auto&& get)
    { activesurface::PrintProperty(os << indent, property, get(*this)); });
  os << indent << "TargetFunction: " << this->TargetFunction << "\n"
     << indent << "InitialFunction: " << this->InitialFunction << "\n"
     << indent << "ObstacleFunction: " << this->ObstacleFunction << "\n"
     << indent << "Controller: " << this->Controller << "\n";
}
