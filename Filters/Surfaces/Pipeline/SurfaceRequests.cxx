#include "Pipeline/SurfaceRequests.h"

#include "Base/TimeSteps.h"
#include "Pipeline/Compatibility.h"
#include "Pipeline/PublishedInformation.h"
#include "Pipeline/RankedRequest.h"
#include "Pipeline/SkinArrays.h"
#include "Ranks/ControllerCommunicator.h"
#include "Ranks/RankedPipeline.h"

#include "vtkAlgorithm.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataObject.h"
#include "vtkExecutive.h"
#include "vtkInformation.h"
#include "vtkInformationExecutivePortVectorKey.h"
#include "vtkInformationVector.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <new>
#include <stdexcept>

using SDDP = vtkStreamingDemandDrivenPipeline;

namespace activesurface
{

namespace
{

vtkInformation* Get(vtkInformationVector** input, SurfaceInput::Ports port) // null if not connected
{
  return input[port]->GetInformationObject(0);
}

}

SurfaceRequests::SurfaceRequests(vtkAlgorithm* filter)
  : Filter(filter)
  , Messages(filter)
  , Target(filter, SurfaceInput::Target, this->Ranks)
  , Initial(filter, SurfaceInput::Initial, this->Ranks)
  , Pushed(filter)
  , Steps(this->Target, this->Simulation)
{
}

void SurfaceRequests::SetController(vtkMultiProcessController* controller)
{
  const bool wasAlone = this->Ranks.IsAlone();
  this->Ranks = MakeAgreement(controller);
  if (!wasAlone || !this->Ranks.IsAlone())
  {
    this->Simulation.Reset();
  }
  RankedPipeline::SetIsOneOfMany(this->Filter, !this->Ranks.IsAlone());
}

SurfaceSettings SurfaceRequests::FindSettings(const SurfaceProperties& properties) const
{
  SurfaceSettings settings = properties.Settings;
  SurfaceInputs& inputs = settings.Inputs;
  if (!inputs.TargetFunction)
  {
    inputs.TargetMTime = this->Target.GetPipelineMTime();
  }
  if (!inputs.InitialFunction)
  {
    inputs.InitialMTime = this->Initial.GetPipelineMTime();
  }
  inputs.Arrays = this->Target.DescribeArrays();
  inputs.HasInitialInput = this->Initial.IsConnected();
  this->Clock.WriteTo(inputs);
  return settings;
}

RequestedArrays SurfaceRequests::FindArrays(const OutputProperties& properties, int port) const
{
  RequestedArrays arrays;
  arrays.Potential = properties.Potential || port == OutputPorts::Potential;
  arrays.Speeds = NeedSpeeds(properties);
  arrays.TangentialVelocity = properties.Velocity && properties.TangentialVelocity;
  arrays.FastestParticle = properties.Velocity && properties.MaximumVelocity == 0.0;
  arrays.Passed = properties.PassTargetArrays;
  if (arrays.NeedParticles())
  {
    arrays.Kept = this->Target.DescribeParticleArrays(arrays.Passed, arrays.TangentialVelocity);
  }
  return arrays;
}

// Returns true if the filter has times to publish.
bool SurfaceRequests::ReadClock(const SurfaceProperties& properties, vtkInformation* target)
{
  const bool isEquilibrium = properties.Settings.IsEquilibrium();
  if (isEquilibrium || this->Pushed.GetTimes().empty())
  {
    this->Pushed.Stop();
    this->Clock.Read(properties.Clock, isEquilibrium, target);
    return !isEquilibrium;
  }
  this->Clock.Read(this->Pushed.GetTimes());
  if (!this->Simulation.IsContinuedBy(this->FindSettings(properties)) &&
    this->Simulation.ListTimesToResume().empty())
  {
    this->Pushed.ForgetPast(); // past frames are unavailable
    this->Clock.Read(this->Pushed.GetTimes());
  }
  return false;
}

void SurfaceRequests::PublishInformation(
  const SurfaceProperties& properties, vtkInformationVector** input, vtkInformationVector* output)
{
  const UpdateInProgress::Scope scope(this->Update);
  const bool hasTimes = this->ReadClock(properties, Get(input, SurfaceInput::Target));
  for (int port = 0; port < OutputPorts::NumberOfPorts; ++port)
  {
    PublishTimes(output->GetInformationObject(port), this->Clock.GetPublishedSteps(), !hasTimes);
  }
  vtkInformation* image = output->GetInformationObject(OutputPorts::Potential);
  const bool isConnected = vtkExecutive::CONSUMERS()->Length(image) > 0;
  PublishExtent(image, this->FindDomain(properties, input, isConnected));
  vtkDataObject::SetPointDataActiveScalarInfo(image, VTK_FLOAT, 1);
  image->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 1);
}

// Returns null if the domain is unavailable. Errors are reported later, when data are requested.
const SurfaceDomain* SurfaceRequests::FindDomain(
  const SurfaceProperties& properties, vtkInformationVector** input, bool isWanted)
{
  try
  {
    this->Simulation.Configure(this->FindSettings(properties));
    const SurfaceDomain* domain = this->Simulation.FindDomain();
    if (!domain && isWanted && this->Ranks.IsAlone()) // reading is collective on several ranks
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

// Updates the inputs to read the first target and the initial shape.
void SurfaceRequests::ReadFirst(vtkInformationVector** input)
{
  vtkInformation* target = Get(input, SurfaceInput::Target);
  vtkInformation* initial = Get(input, SurfaceInput::Initial);
  if (target && this->Simulation.FindMissingStep() == 0 &&
    this->Target.Update(target, this->Simulation.GetSettings().GetStep(0).Value))
  {
    this->SettleSpacing(target);
    this->Steps.AddFirst(target);
  }
  if (initial && this->Simulation.WantsInitial() && this->Initial.UpdateFirst(initial))
  {
    this->Simulation.SetInitial(this->Initial.Read(initial));
  }
}

PipelineTime SurfaceRequests::FindRequestedTime(vtkInformation* output) const
{
  if (this->Clock.ArePushed())
  {
    return this->Clock.GetNewest();
  }
  const std::vector<double>& steps = this->Clock.GetPublishedSteps();
  if (output->Has(SDDP::UPDATE_TIME_STEP()))
  {
    return { output->Get(SDDP::UPDATE_TIME_STEP()) };
  }
  return { steps.empty() ? 0.0 : steps.front() };
}

void SurfaceRequests::RequestInputs(const SurfaceProperties& properties, vtkInformation* request,
  vtkInformationVector** input, vtkInformationVector* output)
{
  const UpdateInProgress::Scope scope(this->Update);
  if (OutputPorts::IsForNothing(this->GetShare(), request, output))
  {
    return;
  }
  vtkInformation* target = Get(input, SurfaceInput::Target);
  const int port = RequestedPort(request);
  const PipelineTime time = this->FindRequestedTime(output->GetInformationObject(port));
  if (this->Clock.Request(target, time.Value))
  {
    this->Simulation.Reset();
  }
  this->Simulation.Configure(this->FindSettings(properties));
  this->Simulation.Request(time, this->FindArrays(properties.Outputs, port));
  if (target)
  {
    this->CompositeTarget =
      this->Target.IsSplit(target) ? this->Target.GetPipelineMTime() : this->CompositeTarget;
    this->Steps.Request(target);
  }
  vtkInformation* initial = Get(input, SurfaceInput::Initial);
  if (initial && this->Initial.IsSplit(initial))
  {
    this->CompositeInitial = this->Initial.GetPipelineMTime();
  }
  // If both ports have the same source, this source is requested at the target's time.
  if (initial && initial != target)
  {
    this->Initial.RequestFirst(initial);
  }
}

// Stores the inputs' MTimes after an update, even a failed one. Some algorithms modify themselves
// while they execute; this change of the MTime must not restart the motion.
class SurfaceRequests::MTimesAfterwards
{
public:
  explicit MTimesAfterwards(SurfaceRequests& requests)
    : Requests(requests)
  {
  }
  MTimesAfterwards(const MTimesAfterwards&) = delete;
  void operator=(const MTimesAfterwards&) = delete;
  ~MTimesAfterwards()
  {
    SurfaceRequests& own = this->Requests;
    if (own.Target.IsConnected())
    {
      own.Simulation.SetTargetMTime(own.Target.GetPipelineMTime());
    }
    if (own.Initial.IsConnected())
    {
      own.Simulation.SetInitialMTime(own.Initial.GetPipelineMTime());
    }
  }

private:
  SurfaceRequests& Requests;
};

// Estimates the particle spacing from several time steps of the target; not for pushed frames,
// because future frames are unavailable.
void SurfaceRequests::SettleSpacing(vtkInformation* target)
{
  if (target && !this->Clock.ArePushed() && this->Simulation.WantsSpacing())
  {
    this->Steps.SettleSpacing(target, this->Ranks);
  }
}

// Advances with the requested inputs, then with further steps of the target as needed.
bool SurfaceRequests::Advance(vtkInformationVector** input)
{
  const MTimesAfterwards afterwards(*this);
  vtkInformation* initial = Get(input, SurfaceInput::Initial);
  vtkInformation* target = Get(input, SurfaceInput::Target);
  if (initial && this->Simulation.WantsInitial())
  {
    if (initial == target && !this->Steps.IsAtFirst() && !this->Initial.UpdateFirst(initial))
    {
      throw std::runtime_error("The update of the input failed at its first time step; see the "
                               "error of the input.");
    }
    this->Simulation.SetInitial(this->Initial.Read(initial));
  }
  this->SettleSpacing(target);
  this->Steps.AddRequested(target);
  const bool mayGoBack =
    !this->Simulation.GetSettings().Inputs.OnlyForward || this->Clock.ArePushed();
  return this->Simulation.Advance([this, target, mayGoBack](int step)
    { return this->Steps.Make(target, step, mayGoBack); },
    [this](double fraction)
    {
      this->Filter->UpdateProgress(fraction);
      return this->Ranks.GoOn(!IsAborted(this->Filter));
    });
}

// Gives an empty piece the time of a piece with data.
void SurfaceRequests::PublishTimeOfNothing(
  const SurfaceProperties& properties, vtkInformation* request, vtkInformationVector* output) const
{
  const int port = RequestedPort(request);
  const PipelineTime asked = this->FindRequestedTime(output->GetInformationObject(port));
  const std::vector<double>& steps = this->Clock.GetPublishedSteps();
  const bool isEquilibrium = properties.Settings.IsEquilibrium();
  PublishTime(vtkDataObject::GetData(output, port),
    steps.empty() ? asked : PipelineTime{ FindStep(steps, asked.Value).Time }, isEquilibrium);
}

// Restarts all ranks if their states differ, as after a change or a failure upstream of one rank.
void SurfaceRequests::AgreeOnRequest(
  const SurfaceProperties& properties, vtkInformation* request, vtkInformationVector* output)
{
  if (RankedPipeline::HaveInputsFailed(this->Filter))
  {
    throw std::runtime_error("The update of an input failed; see the error of that input.");
  }
  const int port = RequestedPort(request);
  const PipelineTime time = this->FindRequestedTime(output->GetInformationObject(port));
  const RequestedArrays arrays = this->FindArrays(properties.Outputs, port);
  if (!activesurface::AgreeOnRequest(
        this->Ranks, properties, this->Simulation, { port, time, arrays.Kept.Velocities }))
  {
    this->Simulation.Reset();
    this->Simulation.Request(time, arrays);
  }
}

// VTK executes a source without CAN_HANDLE_PIECE_REQUEST on rank 0 only, but on all ranks if the
// source makes composite data.
void SurfaceRequests::WarnOfPieces(vtkInformation* target) const
{
  if (target && this->Ranks.GetRank() == 0 &&
    !vtkCompositeDataSet::SafeDownCast(vtkDataObject::GetData(target)) &&
    !target->Has(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST()) && !target->Has(SDDP::WHOLE_EXTENT()))
  {
    this->Simulation.Warn("no pieces",
      "The input of port 0 does not publish CAN_HANDLE_PIECE_REQUEST, so it is read on rank 0 "
      "only. If other ranks have parts of the input, let the source publish this key.");
  }
}

void SurfaceRequests::RequestData(const SurfaceProperties& properties, vtkInformation* request,
  vtkInformationVector** input, vtkInformationVector* output)
{
  const UpdateInProgress::Scope scope(this->Update);
  const auto fill = [&] { this->FillOutputs(properties, request, input, output); };
  const auto startAnew = [this] { this->Simulation.Reset(); };
  RunTogether(this->Ranks, [&] { RunWithinMemory(fill, startAnew, NoMemoryForOutputs); });
}

void SurfaceRequests::FillOutputs(const SurfaceProperties& properties, vtkInformation* request,
  vtkInformationVector** input, vtkInformationVector* output)
{
  this->CheckInputs();
  if (OutputPorts::IsForNothing(this->GetShare(), request, output))
  {
    this->PublishTimeOfNothing(properties, request, output);
    return;
  }
  if (!this->Ranks.IsAlone())
  {
    this->AgreeOnRequest(properties, request, output);
    this->WarnOfPieces(Get(input, SurfaceInput::Target));
  }
  this->Simulation.GetSettings().Check();
  ForEachOutputProperty(properties.Outputs,
    [](const Property& property, const auto& value, auto&&) { CheckProperty(property, value); });
  this->Simulation.SetLimits(properties.Limits);
  if (this->Advance(input))
  {
    this->Pushed.Arrive();
    this->Outputs.Fill(properties, this->Simulation, request, output);
  }
  else
  {
    this->ClearOutputs(output);
  }
}

}
