/**
 * A point in space, or a vector.
 */
#ifndef Point_h
#define Point_h

#include <array>

namespace activesurface
{
using Point = std::array<double, 3>;
}

#endif
