/**
 * Exponentials and roots by additions, multiplications and divisions only: all processors give the
 * same bits. C libraries differ in the last bit, once in a thousand calls, with the processor's
 * instructions and the library's release.
 */
#ifndef PortableMath_h
#define PortableMath_h

#include "ActiveLevelSetExport.h"

namespace activesurface
{

/** e^x, to 1e-15 of its value. */
ACTIVELEVELSET_EXPORT double Exponential(double x);

/** e^x - 1, to 1e-15 of its value even near 0. */
ACTIVELEVELSET_EXPORT double ExponentialMinusOne(double x);

/** To 1e-15 of its value. */
ACTIVELEVELSET_EXPORT double CubeRoot(double x);

}

#endif
