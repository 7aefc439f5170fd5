/** The value -1 of a property leaves the choice to the class. */
#ifndef Automatic_h
#define Automatic_h

namespace activesurface
{

constexpr double Automatic = -1.0;

}

#endif
