// Differences between the supported versions of VTK (9.1 to 9.6).

#ifndef Compatibility_h
#define Compatibility_h

#include "vtkAlgorithm.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkVersionMacros.h"

namespace activesurface
{

// Returns true if the user has asked a running algorithm to stop. Call this from the thread that
// runs the algorithm.
inline bool IsAborted(vtkAlgorithm* algorithm)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 3, 0)
  return algorithm->CheckAbort();
#else
  return algorithm->GetAbortExecute() != 0;
#endif
}

// Access of an input to earlier times (NO_PRIOR_TEMPORAL_ACCESS).
enum class PriorAccess
{
  Free,
  Continue, // no access: this time follows the times requested before
  Reset     // no access: this time starts a new sequence
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
