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

/** Declares that no time of the source is available a second time, once it has executed for its
 * first time again. Returns false for versions of VTK without this feature. */
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
