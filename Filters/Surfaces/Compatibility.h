// What differs between the versions of VTK that this builds with (9.1 to 9.6).

#ifndef Compatibility_h
#define Compatibility_h

#include "vtkAlgorithm.h"
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

}

#endif
