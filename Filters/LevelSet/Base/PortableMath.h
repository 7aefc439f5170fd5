/**
 * Exponentials by exactly rounded operations only, so results are bitwise identical on all
 * processors. The results of C libraries depend on the processor's instructions and on the release
 * of the library: in one of a thousand calls the last bit differs.
 */
#ifndef PortableMath_h
#define PortableMath_h

#include "ActiveLevelSetExport.h"

namespace activesurface
{

/** Returns e^x with a relative error of 1e-15, unless the result is subnormal. */
ACTIVELEVELSET_EXPORT double Exponential(double x);

/** Returns e^x - 1 with a relative error of 1e-15, even near 0. */
ACTIVELEVELSET_EXPORT double ExponentialMinusOne(double x);

}

#endif
