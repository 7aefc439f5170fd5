/** Value of a property that the class chooses itself. */
#ifndef Automatic_h
#define Automatic_h

namespace activesurface
{

constexpr double Automatic = -1.0;

}

#endif
