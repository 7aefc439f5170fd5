// Updates of an input, and detection of changes upstream.

#include "Input/WholeInput.h"
#include "Pipeline/SurfaceInput.h"

#include "vtkAlgorithm.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkInformation.h"
#include "vtkStreamingDemandDrivenPipeline.h"

using SDDP = vtkStreamingDemandDrivenPipeline;

namespace activesurface
{

std::uint64_t SurfaceInput::GetPipelineMTime() const
{
  auto upstream = this->IsConnected()
    ? vtkDemandDrivenPipeline::SafeDownCast(this->Filter->GetInputExecutive(this->Port, 0))
    : nullptr;
  if (!upstream)
  {
    return 0;
  }
  upstream->UpdatePipelineMTime();
  return upstream->GetPipelineMTime();
}

std::vector<double> SurfaceInput::GetTimeSteps(vtkInformation* information)
{
  std::vector<double> steps;
  if (information && information->Has(SDDP::TIME_STEPS()))
  {
    const double* first = information->Get(SDDP::TIME_STEPS());
    steps.assign(first, first + information->Length(SDDP::TIME_STEPS()));
  }
  return steps;
}

bool SurfaceInput::IsContinuous(vtkInformation* information)
{
  if (!information || information->Has(SDDP::TIME_STEPS()) || !information->Has(SDDP::TIME_RANGE()))
  {
    return false;
  }
  const double* range = information->Get(SDDP::TIME_RANGE());
  return range[0] < range[1];
}

void SurfaceInput::Request(vtkInformation* information) const
{
  if (this->Ranks.IsAlone())
  {
    RequestWhole(information);
    return;
  }
  RequestPiece(information, this->Ranks.GetRank(), this->Ranks.GetSize());
}

void SurfaceInput::RequestFirst(vtkInformation* information) const
{
  this->Request(information);
  if (information->Has(SDDP::TIME_STEPS()) && information->Length(SDDP::TIME_STEPS()) > 0)
  {
    information->Set(SDDP::UPDATE_TIME_STEP(), information->Get(SDDP::TIME_STEPS())[0]);
  }
  else if (information->Has(SDDP::TIME_RANGE()))
  {
    information->Set(SDDP::UPDATE_TIME_STEP(), information->Get(SDDP::TIME_RANGE())[0]);
  }
}

bool SurfaceInput::Update(vtkInformation* information, double time) const
{
  this->Request(information);
  information->Set(SDDP::UPDATE_TIME_STEP(), time);
  return this->UpdateProducer();
}

bool SurfaceInput::UpdateFirst(vtkInformation* information) const
{
  this->RequestFirst(information);
  return this->UpdateProducer();
}

bool SurfaceInput::UpdateProducer() const
{
  int port = 0;
  vtkAlgorithm* producer = this->Filter->GetInputAlgorithm(this->Port, 0, port);
  auto upstream = SDDP::SafeDownCast(producer->GetExecutive());
  return upstream && upstream->Update(port);
}

}
