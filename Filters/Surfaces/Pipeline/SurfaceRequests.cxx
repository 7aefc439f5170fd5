#include "Pipeline/SurfaceRequests.h"

#include "Pipeline/Compatibility.h"
#include "Pipeline/FilterProperties.h"
#include "Pipeline/PublishedInformation.h"
#include "Pipeline/SkinPort.h"
#include "Pipeline/SurfaceOutput.h"
#include "vtkActiveImplicitSurface.h"

#include "vtkDataObject.h"
#include "vtkExecutive.h"
#include "vtkInformation.h"
#include "vtkInformationExecutivePortVectorKey.h"
#include "vtkInformationVector.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <stdexcept>

using SDDP = vtkStreamingDemandDrivenPipeline;

namespace activesurface
{

namespace
{

// Another piece of the skin or of the history than the first, which is all of it.
bool IsNothing(vtkInformation* request, vtkInformationVector* output)
{
  const int port = AskedPort(request);
  return port != SurfaceRequests::PotentialPort && IsOtherPiece(output->GetInformationObject(port));
}

// Null if nothing is connected.
vtkInformation* Get(vtkInformationVector** input, SurfaceInput::Ports port)
{
  return input[port]->GetInformationObject(0);
}

}

SurfaceRequests::SurfaceRequests(vtkActiveImplicitSurface* filter)
  : Filter(filter)
  , Target(filter, SurfaceInput::Target)
  , Initial(filter, SurfaceInput::Initial)
{
}

SurfaceSettings SurfaceRequests::GatherSettings() const
{
  SurfaceSettings settings = ReadProperties(this->Filter);
  if (!settings.TargetFunction)
  {
    settings.TargetStamp = this->Target.GetStamp();
  }
  settings.Arrays = this->Target.DescribeArrays();
  settings.HasInitialInput = this->Initial.IsConnected();
  if (!settings.InitialFunction)
  {
    settings.InitialStamp = this->Initial.GetStamp();
  }
  this->Clock.WriteTo(settings);
  return settings;
}

void SurfaceRequests::PublishInformation(vtkInformationVector** input, vtkInformationVector* output)
{
  this->Clock.Read(this->Filter, Get(input, SurfaceInput::Target));
  const bool settles = this->Filter->GetEvolutionMode() == vtkActiveMotionAlgorithm::EQUILIBRIUM;
  for (int port = SkinPort; port <= HistoryPort; ++port)
  {
    PublishTimes(output->GetInformationObject(port), this->Clock.GetPublishedSteps(), settles);
  }
  vtkInformation* image = output->GetInformationObject(PotentialPort);
  const bool isConnected = vtkExecutive::CONSUMERS()->Length(image) > 0;
  PublishExtent(image, this->FindDomain(input, isConnected));
  vtkDataObject::SetPointDataActiveScalarInfo(image, VTK_FLOAT, 1);
  image->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 1);
}

// Null if it is not known. Errors are not told here but when data are asked for.
const SurfaceDomain* SurfaceRequests::FindDomain(vtkInformationVector** input, bool isWanted)
{
  try
  {
    this->Simulation.Configure(this->GatherSettings());
    const SurfaceDomain* domain = this->Simulation.FindDomain();
    if (!domain && isWanted)
    {
      this->ReadFirst(input);
      domain = this->Simulation.FindDomain();
    }
    return domain;
  }
  catch (const std::exception&)
  {
    return nullptr;
  }
}

// What the start needs of the inputs, updated from within.
void SurfaceRequests::ReadFirst(vtkInformationVector** input)
{
  vtkInformation* target = Get(input, SurfaceInput::Target);
  vtkInformation* initial = Get(input, SurfaceInput::Initial);
  if (target && this->Simulation.GetStepWanted() == 0 &&
    this->Target.Update(target, this->Simulation.GetSettings().Steps.front()))
  {
    this->AddFrame(0, target);
  }
  if (initial && this->Simulation.WantsInitial() && this->Initial.UpdateFirst(initial))
  {
    this->Simulation.SetInitial(this->Initial.Read(initial));
  }
}

double SurfaceRequests::GetAskedTime(vtkInformation* output) const
{
  const std::vector<double>& steps = this->Clock.GetPublishedSteps();
  return output->Has(SDDP::UPDATE_TIME_STEP()) ? output->Get(SDDP::UPDATE_TIME_STEP())
    : steps.empty()                            ? 0.0
                                               : steps.front();
}

void SurfaceRequests::AskInputs(
  vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output)
{
  if (IsNothing(request, output))
  {
    return;
  }
  vtkInformation* target = Get(input, SurfaceInput::Target);
  const double time = this->GetAskedTime(output->GetInformationObject(AskedPort(request)));
  if (this->Clock.Ask(target, time))
  {
    this->Simulation.Drop();
  }
  this->Simulation.Configure(this->GatherSettings());
  this->Simulation.SetWishes(ReadWishes(this->Filter, this->Target));
  this->Simulation.SetGoal(time);
  if (target)
  {
    this->AskTarget(target);
  }
  vtkInformation* initial = Get(input, SurfaceInput::Initial);
  if (initial && SurfaceInput::IsComposite(initial))
  {
    this->CompositeInitial = this->Initial.GetStamp();
  }
  // One source at both ports is at the target's time, which is the first one when the start needs
  // it.
  if (initial && initial != target)
  {
    SurfaceInput::AskForFirst(initial);
  }
}

void SurfaceRequests::AskTarget(vtkInformation* target)
{
  if (SurfaceInput::IsComposite(target))
  {
    this->CompositeTarget = this->Target.GetStamp();
  }
  // An algorithm that has failed to make a time is taken by VTK to have made it: only after another
  // time it is asked again.
  const SurfaceSettings& settings = this->Simulation.GetSettings();
  const int wanted = this->Simulation.GetStepWanted();
  const bool isNewest = wanted + 1 == static_cast<int>(settings.Steps.size());
  const bool isReady = wanted >= 0 && (settings.OnlyForward ? isNewest : !this->AskedInVain);
  this->AskedStep = isReady ? wanted : this->Simulation.GetLastStepAdded();
  this->AskedInVain = true;
  SurfaceInput::AskForFirst(target);
  if (settings.InputMoves)
  {
    target->Set(SDDP::UPDATE_TIME_STEP(), settings.Steps[this->AskedStep]);
  }
}

void SurfaceRequests::CheckInputs() const
{
  const bool isFunction = this->Filter->GetTargetFunction() != nullptr;
  if (isFunction && this->Target.IsConnected())
  {
    throw std::invalid_argument("There are two targets, TargetFunction and the input of port 0; "
                                "set TargetFunction to none or disconnect the input.");
  }
  if (!isFunction && !this->Target.IsConnected())
  {
    throw std::invalid_argument(
      "There is no target; set TargetFunction, or connect particles, a skeleton of lines, a closed "
      "mesh or an image to input port 0.");
  }
  if (this->Filter->GetInitialFunction() && this->Initial.IsConnected())
  {
    throw std::invalid_argument("There are two initial shapes, InitialFunction and the input of "
                                "port 1; set InitialFunction to none or disconnect the input.");
  }
  if (this->Target.IsConnected() && this->CompositeTarget == this->Target.GetStamp())
  {
    throw std::invalid_argument("The input is a composite data set, which cannot be a target; "
                                "extract or merge its blocks to one point set or image.");
  }
  if (this->Initial.IsConnected() && this->CompositeInitial == this->Initial.GetStamp())
  {
    throw std::invalid_argument("The input of port 1 is a composite data set, which is no initial "
                                "shape; extract or merge its blocks to one mesh or image.");
  }
}

// Some algorithms modify themselves while they execute, which is no reason to start anew; nor if
// they fail.
class SurfaceRequests::StampsAfterwards
{
public:
  explicit StampsAfterwards(SurfaceRequests& requests)
    : Requests(requests)
  {
  }
  StampsAfterwards(const StampsAfterwards&) = delete;
  void operator=(const StampsAfterwards&) = delete;
  ~StampsAfterwards()
  {
    SurfaceRequests& own = this->Requests;
    if (own.Target.IsConnected())
    {
      own.Simulation.SetTargetStamp(own.Target.GetStamp());
    }
    if (own.Initial.IsConnected())
    {
      own.Simulation.SetInitialStamp(own.Initial.GetStamp());
    }
  }

private:
  SurfaceRequests& Requests;
};

void SurfaceRequests::AddFrame(int step, vtkInformation* target)
{
  this->Simulation.AddFrame(step, this->Target.Read(target, this->Simulation.GetWishes().Kept));
}

// From within, at another time than the one for which it was asked before.
void SurfaceRequests::UpdateTarget(vtkInformation* target, double time)
{
  if (this->Simulation.GetSettings().OnlyForward)
  {
    throw std::runtime_error("The input's time " + std::to_string(time) +
      " is needed, but it cannot be had again (NO_PRIOR_TEMPORAL_ACCESS). Ask for times in their "
      "order; a CheckpointInterval of 1 keeps the skins of earlier ones.");
  }
  this->AskedInVain = true;
  if (!this->Target.Update(target, time))
  {
    throw std::runtime_error(
      "The input has failed to make its time step " + std::to_string(time) + ".");
  }
  this->AskedInVain = false;
}

// Takes what the inputs were asked for, then as many more steps of the target as the goal needs.
SurfaceSimulation::Outcome SurfaceRequests::Advance(vtkInformationVector** input)
{
  const StampsAfterwards stamps(*this);
  vtkInformation* initial = Get(input, SurfaceInput::Initial);
  if (initial && this->Simulation.WantsInitial())
  {
    this->Simulation.SetInitial(this->Initial.Read(initial));
  }
  vtkInformation* target = Get(input, SurfaceInput::Target);
  this->AskedInVain = false;
  if (target && this->Simulation.GetStepWanted() == this->AskedStep)
  {
    this->AddFrame(this->AskedStep, target);
  }
  const auto report = [this](double fraction)
  {
    this->Filter->UpdateProgress(fraction);
    return !IsAborted(this->Filter);
  };
  SurfaceSimulation::Outcome outcome = this->Simulation.Advance(report);
  while (outcome == SurfaceSimulation::Outcome::NeedsFrame)
  {
    const int step = this->Simulation.GetStepWanted();
    this->UpdateTarget(target, this->Simulation.GetSettings().Steps[step]);
    this->AddFrame(step, target);
    outcome = this->Simulation.Advance(report);
  }
  return outcome;
}

void SurfaceRequests::Make(
  vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output)
{
  this->CheckInputs();
  if (IsNothing(request, output))
  {
    return;
  }
  this->Simulation.GetSettings().Check();
  this->Simulation.SetNumberOfThreads(this->Filter->GetNumberOfThreads());
  this->Simulation.SetMaximumNumberOfActiveVoxels(
    static_cast<std::size_t>(this->Filter->GetMaximumNumberOfActiveVoxels()));
  this->Simulation.SetCheckpoints(this->Filter->GetCheckpointInterval(),
    static_cast<std::size_t>(this->Filter->GetCheckpointMemory()) << 20);
  if (this->Advance(input) == SurfaceSimulation::Outcome::AtGoal)
  {
    this->FillOutputs(request, output);
  }
  else
  {
    this->GiveUp(output);
  }
}

void SurfaceRequests::SaveState(const std::string& file) const
{
  const SavedState state = this->Simulation.GetState();
  if (!state.Band || this->Simulation.GetSettings().Settles)
  {
    throw std::runtime_error(
      "There is no state of a time step to save; update the filter first, with "
      "EvolutionMode TRANSIENT.");
  }
  WriteState(file, state);
}

}
