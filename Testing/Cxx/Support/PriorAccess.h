/**
 * Sources that run in situ, as VTK 9.4 and later have them.
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

/** From its next time on, the first again, no time of the source can be had twice. False where VTK
 * does not know that. */
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
