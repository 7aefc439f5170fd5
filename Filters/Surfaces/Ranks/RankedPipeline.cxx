#include "Ranks/RankedPipeline.h"

#include "vtkAlgorithm.h"
#include "vtkInformation.h"
#include "vtkInformationRequestKey.h"
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
  return pipeline && !pipeline->Failed.empty();
}

int RankedPipeline::ForwardUpstream(vtkInformation* request)
{
  const int isDone = this->Superclass::ForwardUpstream(request);
  if (!this->IsOneOfMany)
  {
    return isDone;
  }
  for (vtkInformationRequestKey* kind : { REQUEST_DATA_OBJECT(), REQUEST_INFORMATION(),
         REQUEST_UPDATE_TIME(), REQUEST_UPDATE_EXTENT(), REQUEST_DATA() })
  {
    if (request->Has(kind))
    {
      this->Failed.erase(kind);
      if (!isDone)
      {
        this->Failed.insert(kind);
      }
    }
  }
  return 1;
}

}
