/**
 * Exponentials and roots by additions, multiplications and divisions alone: the same bits on any
 * processor. Those of a C library differ in the last bit, once in a thousand calls, with the
 * processor's instructions and the library's release.
 */
#ifndef PortableMath_h
#define PortableMath_h

#include "ActiveNarrowBandExport.h"

namespace activesurface
{

/** e^x, right to 1e-15. */
ACTIVENARROWBAND_EXPORT double Exponential(double x);

/** e^x - 1, likewise, without cancellation near 0. */
ACTIVENARROWBAND_EXPORT double ExponentialMinusOne(double x);

/** Right to 1e-15. */
ACTIVENARROWBAND_EXPORT double CubeRoot(double x);

}

#endif
