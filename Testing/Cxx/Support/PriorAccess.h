/**
 * Sources that run in situ, supported by VTK 9.4 and later.
 */
#ifndef PriorAccess_h
#define PriorAccess_h

#include "vtkAlgorithm.h"
#include "vtkVersionMacros.h"

namespace activesurface
{

inline bool IsPriorAccessKnown()
{
  return VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 4, 0);
}

/** Declares that the source provides each time only once. Its next execution starts a new sequence
 * of times. Returns false for versions of VTK without this feature. */
inline bool ForbidPriorAccess(vtkAlgorithm* source)
{
#if VTK_VERSION_NUMBER >= VTK_VERSION_CHECK(9, 4, 0)
  source->SetNoPriorTemporalAccessInformationKey();
#else
  static_cast<void>(source);
#endif
  return IsPriorAccessKnown();
}

}

#endif
