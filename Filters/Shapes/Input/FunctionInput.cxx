#include "Input/FunctionInput.h"

#include "Input/WholeInput.h"

#include "vtkAlgorithmOutput.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkInformation.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>

namespace activesurface
{

namespace
{

vtkMTimeType FindPipelineTime(vtkAlgorithm* producer)
{
  auto executive = vtkDemandDrivenPipeline::SafeDownCast(producer->GetExecutive());
  if (!executive)
  {
    return producer->GetMTime();
  }
  executive->UpdatePipelineMTime();
  return executive->GetPipelineMTime();
}

}

bool FunctionInput::SetData(vtkDataObject* data)
{
  const bool changes = this->Data != data || this->Producer;
  this->Data = data;
  this->Producer = nullptr;
  return changes;
}

bool FunctionInput::Connect(vtkAlgorithmOutput* output)
{
  if (output == this->GetConnection() && (output || !this->Data))
  {
    return false;
  }
  this->Data = nullptr;
  this->Producer = output ? output->GetProducer() : nullptr;
  this->Port = output ? output->GetIndex() : 0;
  return true;
}

vtkAlgorithmOutput* FunctionInput::GetConnection() const
{
  return this->Producer ? this->Producer->GetOutputPort(this->Port) : nullptr;
}

vtkMTimeType FunctionInput::GetMTime() const
{
  return this->Producer ? this->Changed.load(std::memory_order_acquire)
    : this->Data        ? this->Data->GetMTime()
                        : 0;
}

vtkMTimeType FunctionInput::FindMTime()
{
  if (this->Producer)
  {
    const vtkMTimeType pipelineTime = FindPipelineTime(this->Producer);
    const vtkMTimeType dataTime = this->Data ? this->Data->GetMTime() : 0;
    if (pipelineTime != this->PipelineTime || dataTime != this->DataTime)
    {
      this->Changed.store(std::max(pipelineTime, dataTime), std::memory_order_release);
      this->Remember();
    }
  }
  return this->GetMTime();
}

// Updates the algorithm without recording a change. A function that became newer by its evaluation
// would restart all dependent filters.
void FunctionInput::Update()
{
  if (!this->Producer)
  {
    return;
  }
  auto executive = vtkStreamingDemandDrivenPipeline::SafeDownCast(this->Producer->GetExecutive());
  if (executive && executive->UpdateInformation())
  {
    RequestWhole(executive->GetOutputInformation(this->Port));
    executive->Update(this->Port);
  }
  this->Data = this->Producer->GetOutputDataObject(this->Port);
  this->Remember();
}

void FunctionInput::Remember()
{
  this->PipelineTime = FindPipelineTime(this->Producer);
  this->DataTime = this->Data ? this->Data->GetMTime() : 0;
}

}
