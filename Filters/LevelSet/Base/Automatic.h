/** Value of a property with the meaning: the program chooses the value. */
#ifndef Automatic_h
#define Automatic_h

namespace activesurface
{

constexpr double Automatic = -1.0;

}

#endif
