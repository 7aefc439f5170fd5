#include "Ranks/RankedPipeline.h"

#include "vtkAlgorithm.h"
#include "vtkInformation.h"
#include "vtkObjectFactory.h"

namespace activesurface
{

vtkStandardNewMacro(RankedPipeline);

void RankedPipeline::SetIsOneOfMany(vtkAlgorithm* algorithm, bool isOneOfMany)
{
  if (auto pipeline = SafeDownCast(algorithm->GetExecutive()))
  {
    pipeline->IsOneOfMany = isOneOfMany;
  }
}

bool RankedPipeline::HaveInputsFailed(vtkAlgorithm* algorithm)
{
  const auto pipeline = SafeDownCast(algorithm->GetExecutive());
  return pipeline && (pipeline->InformationFailed || pipeline->DataFailed);
}

int RankedPipeline::ForwardUpstream(vtkInformation* request)
{
  const int isDone = this->Superclass::ForwardUpstream(request);
  if (!this->IsOneOfMany)
  {
    return isDone;
  }
  const bool isForData = request->Has(REQUEST_DATA()) || request->Has(REQUEST_UPDATE_EXTENT());
  bool& hasFailed = isForData ? this->DataFailed : this->InformationFailed;
  // Requests come in pairs: UPDATE_EXTENT before DATA, and DATA_OBJECT before INFORMATION. A
  // failure of the first request is kept during the second.
  const bool isSecond = request->Has(REQUEST_DATA()) || request->Has(REQUEST_INFORMATION());
  hasFailed = !isDone || (isSecond && hasFailed);
  return 1;
}

}
