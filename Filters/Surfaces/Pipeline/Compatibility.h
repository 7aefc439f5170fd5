// What differs between the versions of VTK that this builds with (9.1 to 9.6).

#ifndef Compatibility_h
#define Compatibility_h

#include "vtkAlgorithm.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkVersionMacros.h"

namespace activesurface
{

// Whether the user has asked a running algorithm to stop; to be called by the thread that runs it.
inline bool IsAborted(vtkAlgorithm* algorithm)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
  return algorithm->CheckAbort();
#else
  return algorithm->GetAbortExecute() != 0;
#endif
}

// Whether times of an input can be had again, and in any order.
enum class PriorAccess
{
  Free,
  Continue, // no: this time comes after those that were asked for before
  Reset     // no: this time is the first
};

inline PriorAccess GetPriorAccess(vtkInformation* input)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 4, 0)
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  if (!input->Has(Pipeline::NO_PRIOR_TEMPORAL_ACCESS()))
  {
    return PriorAccess::Free;
  }
  const int state = input->Get(Pipeline::NO_PRIOR_TEMPORAL_ACCESS());
  return state == Pipeline::NO_PRIOR_TEMPORAL_ACCESS_RESET ? PriorAccess::Reset
                                                           : PriorAccess::Continue;
#else
  static_cast<void>(input);
  return PriorAccess::Free;
#endif
}

}

#endif
