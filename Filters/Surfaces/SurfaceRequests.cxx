#include "SurfaceRequests.h"

#include "Compatibility.h"
#include "SurfaceOutput.h"
#include "vtkActiveImplicitSurface.h"

#include "vtkDataObject.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkExecutive.h"
#include "vtkImageData.h"
#include "vtkImplicitFunction.h"
#include "vtkInformation.h"
#include "vtkInformationExecutivePortVectorKey.h"
#include "vtkInformationVector.h"
#include "vtkPolyData.h"
#include "vtkSetGet.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <stdexcept>

using SDDP = vtkStreamingDemandDrivenPipeline;

namespace activesurface
{

namespace
{

bool IsEmpty(const int extent[6])
{
  return extent[0] > extent[1] || extent[2] > extent[3] || extent[4] > extent[5];
}

int AskedPort(vtkInformation* request)
{
  return std::max(0, request->Get(vtkExecutive::FROM_OUTPUT_PORT()));
}

}

SurfaceRequests::SurfaceRequests(vtkActiveImplicitSurface* filter)
  : Filter(filter)
  , Input(filter)
{
}

SurfaceSettings SurfaceRequests::GatherSettings() const
{
  constexpr double unset[6] = { 1.0, -1.0, 1.0, -1.0, 1.0, -1.0 };
  vtkActiveImplicitSurface* filter = this->Filter;
  SurfaceSettings settings;
  settings.TargetFunction = filter->GetTargetFunction();
  settings.ParticlesMove = this->InputMoves;
  settings.TargetStamp = settings.TargetFunction
    ? static_cast<std::uint64_t>(settings.TargetFunction->GetMTime())
    : this->Input.GetStamp();
  settings.Particles.Radius = filter->GetParticleRadius();
  settings.Particles.Threshold = filter->GetParticleThreshold();
  settings.Particles.Kernel = static_cast<SkeletonKernel>(filter->GetParticleKernel());
  settings.Particles.Arrays = this->Input.DescribeArrays();
  settings.IsoValue = filter->GetTargetIsoValue();
  settings.Invert = filter->GetInvertTarget() != 0;
  settings.Normalize = filter->GetNormalizeTarget() != 0;
  settings.Reach = filter->GetTargetReach();
  settings.InitialFunction = filter->GetInitialFunction();
  settings.InitialStamp = settings.InitialFunction ? settings.InitialFunction->GetMTime() : 0;
  settings.VoxelSize = filter->GetVoxelSize();
  filter->GetModelBounds(settings.Bounds.data());
  settings.BoundsGiven = !std::equal(unset, unset + 6, settings.Bounds.data());
  settings.Strategy.Attraction = filter->GetAttraction();
  settings.Strategy.Tension = filter->GetTension();
  settings.Strategy.CFL = filter->GetCFL();
  settings.Steps = this->Steps;
  settings.TimeScale = filter->GetTimeScale();
  return settings;
}

void SurfaceRequests::FindTimeSteps(vtkInformation* input)
{
  this->Steps = TargetInput::GetTimeSteps(input);
  this->InputMoves = !this->Steps.empty() || TargetInput::IsContinuous(input);
  if (this->Steps.empty())
  {
    const int count = this->Filter->GetNumberOfTimeSteps();
    for (int i = 0; i < count; ++i)
    {
      this->Steps.push_back(this->Filter->GetStartTime() + i * this->Filter->GetTimeStepSize());
    }
  }
}

void SurfaceRequests::PublishInformation(vtkInformation* input, vtkInformationVector* output)
{
  this->FindTimeSteps(input);
  for (int port = SkinPort; port <= PotentialPort; ++port)
  {
    const double range[2] = { this->Steps.front(), this->Steps.back() };
    vtkInformation* out = output->GetInformationObject(port);
    out->Set(SDDP::TIME_STEPS(), this->Steps.data(), static_cast<int>(this->Steps.size()));
    out->Set(SDDP::TIME_RANGE(), range, 2);
  }
  vtkInformation* image = output->GetInformationObject(PotentialPort);
  const bool isConnected = vtkExecutive::CONSUMERS()->Length(image) > 0;
  this->PublishExtent(image, this->FindDomain(input, isConnected));
  vtkDataObject::SetPointDataActiveScalarInfo(image, VTK_FLOAT, 1);
  image->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 1);
}

// Null if it is not known. Errors are not told here but when data are asked for.
const SurfaceDomain* SurfaceRequests::FindDomain(vtkInformation* input, bool isWanted)
{
  try
  {
    this->Simulation.Configure(this->GatherSettings());
    const SurfaceDomain* domain = this->Simulation.FindDomain();
    if (!domain && isWanted && input && !this->Filter->GetTargetFunction() &&
      this->Input.Update(input, this->Steps.front()))
    {
      this->Simulation.AddParticles(0, this->Input.Read(input));
      domain = this->Simulation.FindDomain();
    }
    return domain;
  }
  catch (const std::exception&)
  {
    return nullptr;
  }
}

void SurfaceRequests::PublishExtent(vtkInformation* output, const SurfaceDomain* domain) const
{
  constexpr int empty[6] = { 0, -1, 0, -1, 0, -1 };
  int extent[6];
  if (!domain || !domain->GetExtent(extent))
  {
    std::copy(empty, empty + 6, extent);
  }
  const double size = domain ? domain->VoxelSize : 1.0;
  output->Set(SDDP::WHOLE_EXTENT(), extent, 6);
  output->Set(vtkDataObject::ORIGIN(), 0.0, 0.0, 0.0);
  output->Set(vtkDataObject::SPACING(), size, size, size);
}

bool SurfaceRequests::Makes(int port, vtkInformation* request) const
{
  return port == AskedPort(request) ||
    (port == PotentialPort && this->Filter->GetOutputPotential());
}

void SurfaceRequests::MarkNotMade(vtkInformation* request, vtkInformationVector* output) const
{
  for (int port = SkinPort; port <= PotentialPort; ++port)
  {
    if (!this->Makes(port, request))
    {
      output->GetInformationObject(port)->Set(vtkDemandDrivenPipeline::DATA_NOT_GENERATED(), 1);
    }
  }
}

void SurfaceRequests::AskInput(
  vtkInformation* request, vtkInformation* input, vtkInformationVector* output)
{
  vtkInformation* out = output->GetInformationObject(AskedPort(request));
  this->Simulation.Configure(this->GatherSettings());
  this->Simulation.SetGoal(
    out->Has(SDDP::UPDATE_TIME_STEP()) ? out->Get(SDDP::UPDATE_TIME_STEP()) : this->Steps.front());
  if (!input)
  {
    return;
  }
  if (TargetInput::IsComposite(input))
  {
    this->CompositeStamp = this->Input.GetStamp();
  }
  const int wanted = this->Simulation.GetStepWanted();
  this->AskedStep = wanted >= 0 ? wanted : this->Simulation.GetLastStepAdded();
  if (this->InputMoves)
  {
    input->Set(SDDP::UPDATE_TIME_STEP(), this->Steps[this->AskedStep]);
  }
  else if (input->Has(SDDP::TIME_STEPS()))
  {
    input->Set(SDDP::UPDATE_TIME_STEP(), input->Get(SDDP::TIME_STEPS())[0]);
  }
  TargetInput::AskForWhole(input);
}

void SurfaceRequests::CheckTarget() const
{
  const bool isFunction = this->Filter->GetTargetFunction() != nullptr;
  if (isFunction && this->Input.IsConnected())
  {
    throw std::invalid_argument("There are two targets, TargetFunction and the input of port 0; "
                                "set TargetFunction to none or disconnect the input.");
  }
  if (!isFunction && !this->Input.IsConnected())
  {
    throw std::invalid_argument(
      "There is no target; set TargetFunction, or connect particles to input port 0.");
  }
  if (this->Input.IsConnected() && this->CompositeStamp == this->Input.GetStamp())
  {
    throw std::invalid_argument("The input is a composite data set, which cannot be a target; "
                                "extract or merge its blocks to one point set.");
  }
}

// Takes the step that the input was asked for, then as many more as the goal needs.
SurfaceSimulation::Outcome SurfaceRequests::Advance(vtkInformation* input)
{
  if (input && this->Simulation.GetStepWanted() == this->AskedStep)
  {
    this->Simulation.AddParticles(this->AskedStep, this->Input.Read(input));
  }
  const auto report = [this](double fraction)
  {
    this->Filter->UpdateProgress(fraction);
    return !IsAborted(this->Filter);
  };
  SurfaceSimulation::Outcome outcome = this->Simulation.Advance(report);
  while (outcome == SurfaceSimulation::Outcome::NeedsParticles)
  {
    const int step = this->Simulation.GetStepWanted();
    if (!this->Input.Update(input, this->Steps[step]))
    {
      throw std::runtime_error(
        "The input has failed to make its time step " + std::to_string(this->Steps[step]) + ".");
    }
    this->Simulation.AddParticles(step, this->Input.Read(input));
    outcome = this->Simulation.Advance(report);
  }
  return outcome;
}

void SurfaceRequests::Make(
  vtkInformation* request, vtkInformation* input, vtkInformationVector* output)
{
  this->CheckTarget();
  this->Simulation.GetSettings().Check();
  this->Simulation.SetNumberOfThreads(this->Filter->GetNumberOfThreads());
  this->Simulation.SetMaximumNumberOfActiveVoxels(
    static_cast<std::size_t>(this->Filter->GetMaximumNumberOfActiveVoxels()));
  if (this->Advance(input) == SurfaceSimulation::Outcome::Aborted)
  {
    this->GiveUp(output);
    return;
  }
  // Some algorithms modify themselves while they execute, which is no reason to start anew.
  if (input)
  {
    this->Simulation.SetTargetStamp(this->Input.GetStamp());
  }
  this->FillOutputs(request, output);
}

void SurfaceRequests::FillOutputs(vtkInformation* request, vtkInformationVector* output)
{
  const NarrowBand& band = this->Simulation.GetBand();
  const double time = this->Simulation.GetGoalTime();
  if (this->Makes(SkinPort, request))
  {
    vtkPolyData* skin = vtkPolyData::GetData(output, SkinPort);
    FillSkin(band, this->Filter->GetComputeNormals() != 0, skin);
    skin->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), time);
  }
  // The extent may be known since now only.
  vtkInformation* out = output->GetInformationObject(PotentialPort);
  this->PublishExtent(out, this->Simulation.FindDomain());
  int extent[6] = { 0, -1, 0, -1, 0, -1 };
  out->Get(SDDP::UPDATE_EXTENT(), extent);
  if (IsEmpty(extent))
  {
    out->Get(SDDP::WHOLE_EXTENT(), extent);
    out->Set(SDDP::UPDATE_EXTENT(), extent, 6);
  }
  if (this->Makes(PotentialPort, request))
  {
    vtkImageData* potential = vtkImageData::GetData(output, PotentialPort);
    FillPotential(band, extent, potential);
    potential->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), time);
  }
}

void SurfaceRequests::GiveUp(vtkInformationVector* output)
{
  this->Simulation.Drop();
  for (int port = SkinPort; port <= PotentialPort; ++port)
  {
    vtkInformation* out = output->GetInformationObject(port);
    vtkDataObject::GetData(out)->Initialize();
    out->Set(vtkDemandDrivenPipeline::DATA_NOT_GENERATED(), 1);
  }
}

}
