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
  // UPDATE_EXTENT precedes DATA, and DATA_OBJECT precedes INFORMATION: a second request keeps the
  // failure of the first.
  const bool isSecond = request->Has(REQUEST_DATA()) || request->Has(REQUEST_INFORMATION());
  hasFailed = !isDone || (isSecond && hasFailed);
  return 1;
}

}
